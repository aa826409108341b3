// Names are a contract with scripts, as those of stats.cpp.
#include "analysis/pruning_report.h"

namespace whittle {

nlohmann::ordered_json pruningToJson(const PruningReport& t) {
  const auto things = [](const PruningReport::Things& c) {
    return nlohmann::ordered_json{
        {"all", c.all}, {"kept", c.kept()}, {"unused", c.unused}, {"alike", c.alike}};
  };
  nlohmann::ordered_json lights{{"all", t.lights},
                                {"kept", t.lights - t.droppedLights.size()},
                                {"dropped", nlohmann::ordered_json::array()}};
  for (const auto& l : t.droppedLights)
    lights["dropped"].push_back({{"index", l.index}, {"name", l.name}, {"reason", l.reason}});
  return {{"materials", things(t.materials)}, {"textures", things(t.images)},
          {"vertices", things(t.vertices)},   {"lights", lights},
          {"needlessMasks", t.needlessMasks}, {"needlessBlends", t.needlessBlends}};
}

}  // namespace whittle

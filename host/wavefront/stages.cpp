// The table as a list, and the proof that its arguments are the kernels'.
#include "wavefront/stages.h"

#include "kernel_parameters.h"  // generated at build time: the parameter lists of the kernels' text

namespace whittle {
namespace {

/// Element `index` of a list whose elements a comma and a blank part.
consteval std::string_view element(std::string_view list, std::size_t index) {
  for (; index > 0; --index) list.remove_prefix(list.find(", ") + 2);
  return list.substr(0, list.find(", "));
}

consteval std::size_t elements(std::string_view list) {
  std::size_t count = list.empty() ? 0 : 1;
  for (std::size_t at = list.find(", "); at != list.npos; at = list.find(", ", at + 2)) ++count;
  return count;
}

consteval std::string_view parametersOf(std::string_view kernel) {
  for (const auto& [name, parameters] : kKernelParameters)
    if (name == kernel) return parameters;
  return {};
}

/// "TYPE NAME", as the kernel has it; the scene's parameters are a macro and have no name.
consteval bool isParameter(std::string_view text, std::string_view type, std::string_view name) {
  if (text == type) return type == kKernelType<SceneArgument>;
  return !type.empty() && text.size() == type.size() + 1 + name.size() && text.starts_with(type) &&
         text[type.size()] == ' ' && text.ends_with(name);
}

template <typename S, std::size_t... I>
consteval bool matches(std::index_sequence<I...>) {
  using Arguments = decltype(std::declval<S>().arguments());
  constexpr std::string_view parameters = parametersOf(S::stage.facts.name);
  return elements(parameters) == sizeof...(I) &&
         (isParameter(element(parameters, I),
                      kKernelType<std::remove_cvref_t<std::tuple_element_t<I, Arguments>>>,
                      element(S::argumentNames, I)) &&
          ...);
}

template <typename S>
struct IsTheKernels {
  using Arguments = decltype(std::declval<S>().arguments());
  static_assert(
      matches<S>(std::make_index_sequence<std::tuple_size_v<Arguments>>()),
      "WHITTLE_ARGUMENTS of this stage and the parameters of its kernel differ in name, type or order");
};
template <typename... S>
constexpr bool allAreTheKernels(const std::tuple<S...>*) {
  return (sizeof(IsTheKernels<S>) + ...) > 0;
}
static_assert(allAreTheKernels(static_cast<const Stages*>(nullptr)));

/// Names of a list of "TYPE NAME".
consteval bool namesAre(std::string_view parameters, std::string_view names) {
  if (elements(parameters) != elements(names)) return false;
  for (std::size_t i = 0; i < elements(names); ++i) {
    const std::string_view parameter = element(parameters, i);
    if (parameter.substr(parameter.rfind(' ') + 1) != element(names, i)) return false;
  }
  return true;
}
static_assert(namesAre(parametersOf("SCENE_PARAMS"), DeviceScene::argumentNames),
              "DeviceScene and SCENE_PARAMS differ");

}  // namespace

const std::vector<Stage>& allStages() {
  static const std::vector<Stage> all = [] {
    std::vector<Stage> rows;
    forEachStage([&]<typename S>(const S&) { rows.push_back(S::stage); });
    return rows;
  }();
  return all;
}

std::vector<std::string> plannedStages(const StageConditions& conditions) {
  std::vector<std::string> names;
  for (const Stage& stage : allStages())
    if (stage.runs(conditions)) names.emplace_back(stage.facts.name);
  return names;
}

}  // namespace whittle

// What is written to files: beside the window's thread, one after the other. The window waits when it closes.
#include <chrono>
#include <utility>

#include "view/viewer.h"

namespace whittle::view {

void Viewer::save() {
  if (!shown_.result || !scene_ || shown_.coarse) return say(true, "there is no picture yet");
  // Around a region the picture is of other settings, or of none.
  std::string name = file_.stem().string();
  if (shown_.region) name += "-crop-" + services_.value(shown_.asked, "crop");
  saveAside("writing the picture", [this, name, shown = shown_, scene = scene_, settings = settings_] {
    const std::string wrote =
        services_.save(name, shown.region ? *shown.region : *shown.result, *scene, settings);
    return shown.region ? wrote + ": the region alone" : wrote;
  });
}

/// `write` returns what it wrote.
void Viewer::saveAside(const char* doing, std::function<std::string()> write) {
  say(false, std::string(doing) + " …");
  saves_.push_back(std::async(std::launch::async, [this, write = std::move(write)] {
    Message message;
    try {
      const std::lock_guard lock(saving_);
      message = {false, write()};
    } catch (const std::exception& e) {
      message = {true, e.what()};
    }
    services_.wake();
    return message;
  }));
}

/// True: something was written, or could not be.
bool Viewer::takeSaved() {
  const std::size_t before = saves_.size();
  std::erase_if(saves_, [this](std::future<Message>& save) {
    if (save.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    Message message = save.get();
    say(message.isError, std::move(message.text));
    return true;
  });
  return saves_.size() != before;
}

}  // namespace whittle::view

// A reference beside the picture: which one, how the two are shown, how far they are apart.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "view/live_comparison.h"
#include "view/view_model.h"

namespace whittle::view {

class Comparison {
 public:
  /// `read`: a reference from a file, on another thread; throws InputError. `wake`: as Services::wake.
  Comparison(std::function<Reference(const std::filesystem::path&)> read, std::function<void()> wake);

  /// Its settings as widgets.
  static std::vector<Control> controls();
  /// Whether `id` is one of them.
  static bool has(const std::string& id);
  std::string value(const std::string& id) const;
  /// As ViewModel::set.
  std::string set(const std::string& id, const std::string& text);

  /// This radiance is the reference from now on.
  void keep(const FloatImage& radiance);
  /// The picture that is shown, whole and not coarse, and what makes its codes; again for another exposure.
  void show(std::shared_ptr<const RenderResult> picture,
            std::function<std::vector<std::uint8_t>(const FloatImage&)> codes);

  /// Takes over what the other thread has done. True: something is new. Adds what the user should read.
  bool update(std::vector<ViewModel::Message>& messages);
  const CompareView& view() const { return view_; }
  nlohmann::ordered_json state() const;

 private:
  void take(std::shared_ptr<const Reference> reference);
  void compare();
  /// Why it cannot be compared with the picture that is shown; empty: it can, or there is none.
  std::string problemOf(const Reference& reference) const;
  bool isComparable() const { return reference_ && pictures_.picture && problemOf(*reference_).empty(); }

  std::function<Reference(const std::filesystem::path&)> read_;
  std::shared_ptr<const Reference> reference_;  ///< null: none
  Comparable pictures_;                         ///< the newest
  std::string file_;                            ///< of the reference, as it was asked for
  bool isDue_ = false;  ///< pictures_ wait to be compared until something is to be seen of it
  std::string said_;    ///< why the two are not compared, when it was last said
  CompareView view_;
  std::uint64_t comparedSerial_ = 0;
  LiveComparison live_;  ///< last: its thread uses read_
};

}  // namespace whittle::view

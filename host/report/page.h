// A report as one HTML file that needs nothing else: no network, no other file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace whittle {

/// The page that `script` (a file of report/page/, by its name) draws from `data`, which it holds as JSON.
/// `title`: plain text. Throws std::out_of_range for an unknown script.
std::string pageText(const std::string& title, const std::string& script, const nlohmann::ordered_json& data);

}  // namespace whittle

// What report pages are made of: each file of report/page/ by its name.
#pragma once

#include <map>
#include <string>

namespace whittle {

const std::map<std::string, std::string>& pageTexts();

}  // namespace whittle

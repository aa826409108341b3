// The sub-commands. Each function adds one to the application and returns nothing; when it was chosen, its
// callback stores the exit status: 0 done, 1 failed. Unusable input leaves as an exception and becomes status
// 2 in main.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace whittle::cli {

/// `arguments`: of the program, without its name.
void addRender(CLI::App& app, int& status, const std::vector<std::string>& arguments);
void addReference(CLI::App& app, int& status);
void addInfo(CLI::App& app, int& status);
void addDevices(CLI::App& app, int& status);
void addCheck(CLI::App& app, int& status);
void addCache(CLI::App& app, int& status);
void addCompare(CLI::App& app, int& status);
void addBench(CLI::App& app, int& status);
void addScale(CLI::App& app, int& status, const std::vector<std::string>& arguments);
void addView(CLI::App& app, int& status);

}  // namespace whittle::cli

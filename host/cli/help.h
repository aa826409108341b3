// Help texts: each option once, `--name PLACEHOLDER   text [default]`, in named groups, 80 columns.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace whittle::cli {

class HelpFormatter : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

}  // namespace whittle::cli

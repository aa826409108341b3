// Lets a struct list the members that are a kernel's parameters.
#pragma once

#include <string_view>
#include <tuple>

/// All members that are parameters of a kernel, in its order and by its names. Gives the struct a tuple of
/// them and their names, to be held against the kernel's text (stages.cpp).
#define WHITTLE_ARGUMENTS(...)                                    \
  static constexpr std::string_view argumentNames = #__VA_ARGS__; \
  auto arguments() const { return std::tie(__VA_ARGS__); }

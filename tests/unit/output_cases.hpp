#pragma once
/// Folders and messages for tests of what is written.

#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "scratch_folder.hpp"

namespace crampon {

namespace fs = std::filesystem;

// A folder of its own for each test, removed at its end.
class Output : public testing::Test {
 protected:
  const ScratchFolder scratch;
  const fs::path folder = scratch.path();
};

inline std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "nothing was thrown";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace crampon

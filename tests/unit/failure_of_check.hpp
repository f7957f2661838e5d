#pragma once
/// Tests of checks: a check that cannot fail checks nothing.

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace crampon::test {

/// Do some of the failures of a check say this?
inline testing::AssertionResult finds(const std::string& what, const std::function<void()>& check) {
  testing::TestPartResultArray results;
  {
    const testing::ScopedFakeTestPartResultReporter reporter(testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD,
                                                             &results);
    check();
  }
  for (int k = 0; k < results.size(); ++k) {
    if (std::string(results.GetTestPartResult(k).message()).find(what) != std::string::npos) return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << results.size() << " failures, none of which says: " << what;
}

}  // namespace crampon::test

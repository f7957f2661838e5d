#pragma once
/// What goes wrong, told so that it can be mended: bad input (exit code 2) and a run that cannot go on (exit code 3).

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace crampon {

/// A place in an input file. Lines and columns count from 1; 0 means "the file as a whole".
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  std::string where;  ///< path of the entry, as "body[0].shape.radius"
};

/// Base of every record read from an input: remembers where it and each of its keys stood, so that later checks can point there.
struct Located {
  Location location;
  std::map<std::string, Location> keys;
  /// Place of a key, or of the record when the key was left to its default.
  const Location& at(const std::string& key) const {
    const auto found = keys.find(key);
    return found == keys.end() ? location : found->second;
  }
};

/// One thing wrong with the input.
struct Diagnostic {
  Location location;
  std::string what;    ///< what is wrong
  std::string why;     ///< why that is a problem; may be empty
  std::string remedy;  ///< what to do
  /// "file:line:column: where: what (why); remedy"
  std::string text() const;
};

/// All that is wrong with an input, reported in one go. Nothing has been written when it is thrown. Exit code 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// A run that cannot go on (NaN, particle out of the grid, ...): names step, time, particle and what usually helps. Exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace crampon

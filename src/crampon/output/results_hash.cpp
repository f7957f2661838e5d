#include "crampon/output/results_hash.hpp"

#include <cstring>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

namespace crampon {

namespace {

class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char b : bytes) h_ = (h_ ^ static_cast<unsigned char>(b)) * 1099511628211ull;
  }
  void add(double value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    add(std::string_view(bytes, sizeof value));
  }
  template <class Values>
  void add_all(const Values& values) {
    for (const double v : values) add(v);
  }
  void add(const std::vector<DataArray>& fields) {
    for (const DataArray& field : fields) {
      add(std::string_view(field.name));
      add_all(field.values);
    }
  }
  std::uint64_t value() const { return h_; }

 private:
  std::uint64_t h_ = 14695981039346656037ull;
};

}  // namespace

std::uint64_t hash_results(const ResultsFolder& folder) {
  const std::vector<PvdEntry> particles = folder.particle_frames(), cracks = folder.crack_frames();
  if (particles.empty()) throw std::runtime_error(fmt::format("{}: there are no frames", folder.path().string()));
  Hash hash;
  const PointFrame frame = folder.read_particles(particles.back());
  hash.add(frame.time);
  hash.add(static_cast<double>(frame.step));
  hash.add_all(frame.positions);
  hash.add(frame.fields);
  if (!cracks.empty()) {
    const CrackFrame lines = folder.read_cracks(cracks.back());
    for (const auto* points : {&lines.plane, &lines.upper, &lines.lower}) hash.add_all(*points);
    hash.add(lines.fields);
  }
  return hash.value();
}

}  // namespace crampon

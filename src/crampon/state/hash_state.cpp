#include "crampon/core/parallel.hpp"
#include "crampon/state/state.hpp"

namespace crampon {

namespace {

/// What particle p has in an array.
template <class Record>
void add_entries(BitHash& hash, const AlignedArray<Record>& array, PerParticle layout, std::size_t p) {
  hash.add(array.data() + p * layout.width, layout.width * sizeof(Record));
}
void add_entries(BitHash& hash, const AlignedArray<Pack>& array, PerPack layout, std::size_t p) {
  for (std::size_t c = 0; c < layout.width; ++c) hash.add(double{array[p / lanes * layout.width + c][p % lanes]});
}

template <int Dim>
std::uint64_t hash_particles(const Particles<Dim>& particles, const ParticleOrder& order, int threads) {
  std::vector<std::int64_t> block_of_run(order.runs.size(), -1);
  for (const OccupiedBlock& b : order.blocks) {
    for (std::uint32_t r = b.first_run; r < b.end_run; ++r) block_of_run[r] = b.number;
  }
  std::vector<std::uint64_t> sums(order.runs.size(), 0);
  parallel_for(order.runs.size(), threads, [&](std::size_t r) {
    const Run& run = order.runs[r];
    for (std::size_t p = std::size_t{run.first_pack} * lanes; p < std::size_t{run.end_pack} * lanes; ++p) {
      if (particles.is_padding(p)) continue;
      BitHash hash;
      hash.add(block_of_run[r]);
      hash.add(std::uint64_t{run.material});
      hash.add(std::uint64_t{p - std::size_t{run.first_pack} * lanes});
      Particles<Dim>::for_arrays(particles, [&](const Member& m, const auto& array, auto layout) {
        if (m.use == Use::course) add_entries(hash, array, layout, p);
      });
      sums[r] += hash.value();
    }
  });
  std::uint64_t sum = 0;
  for (const std::uint64_t s : sums) sum += s;
  return sum;
}

}  // namespace

template <int Dim>
std::uint64_t hash_state(const State<Dim>& state, int threads) {
  BitHash hash;
  State<Dim>::for_members(state, [&](const Member&, const auto& member) {
    using T = std::remove_cvref_t<decltype(member)>;
    if constexpr (std::is_same_v<T, Particles<Dim>>) {
      hash.add(hash_particles(member, state.order, threads));
      hash.add(member.lead);
    } else if constexpr (std::is_same_v<T, ParticleOrder>) {  // runs and blocks: with the particles
      hash.add(member.must_reorder);
      hash.add(std::uint64_t{member.particle_count});
    } else {
      write_member(member, "", Member{""}, [&](const std::string&, const Member& m, const ArrayLayout& layout, const void* data) {
        if (m.use != Use::course) return;
        hash.add(std::uint64_t{layout.rows});
        hash.add(data, layout.bytes());
      });
    }
  });
  return hash.value();
}

template std::uint64_t hash_state<2>(const State<2>&, int);
template std::uint64_t hash_state<3>(const State<3>&, int);

}  // namespace crampon

#include "crampon/output/results_folder.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

#include "crampon/output/file.hpp"
#include "crampon/output/run_record.hpp"

namespace crampon {
namespace {

namespace fs = std::filesystem;

constexpr const char* series_names[] = {"particles", "cracks", "grid"};
constexpr const char* file_names[] = {"particles.pvd",       "cracks.pvd",          "grid.pvd", "history.csv", "events.csv",
                                      "input.resolved.toml", "input.original.toml", "run.json"};

std::string frame_name(std::string_view series, std::size_t index) { return fmt::format("{}_{:06}.vtp", series, index); }

// "particles_000012.vtp" or the temporary file of one.
bool is_frame_name(std::string_view name, std::string_view series) {
  if (name.ends_with(".partial")) name.remove_suffix(8);
  if (!name.starts_with(series) || !name.ends_with(".vtp")) return false;
  name.remove_prefix(series.size());
  name.remove_suffix(4);
  return name.size() >= 7 && name.front() == '_' &&
         std::all_of(name.begin() + 1, name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

// All files in the folder that a run may have written. A linked sub-folder is somebody else's.
std::vector<fs::path> written_files(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const char* name : file_names)
    for (const fs::path& path : {folder / name, partial_name(folder / name)})
      if (fs::is_regular_file(fs::symlink_status(path))) found.push_back(path);
  for (const char* series : series_names) {
    if (!fs::is_directory(fs::symlink_status(folder / series))) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / series))
      if (is_frame_name(entry.path().filename().string(), series) && fs::is_regular_file(entry.symlink_status()))
        found.push_back(entry.path());
  }
  return found;
}

// Pictures show one run; those of an older one would lie beside the new results.
std::vector<fs::path> drawn_pictures(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!fs::is_directory(fs::symlink_status(folder / "pictures"))) return found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "pictures"))
    if (entry.path().extension() == ".png" && fs::is_regular_file(entry.symlink_status())) found.push_back(entry.path());
  return found;
}

[[noreturn]] void fail(const fs::path& path, const char* verb, const std::error_code& code) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path.string(), verb, code.message()));
}

void create_folder(const fs::path& path) {
  std::error_code code;
  fs::create_directories(path, code);
  if (code) fail(path, "create folder", code);
  if (!fs::is_directory(path)) fail(path, "create folder", std::make_error_code(std::errc::not_a_directory));
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path path)
    : path_(std::move(path)), particles_(particles_series()), cracks_(cracks_series()), grid_(grid_series()) {}

void ResultsFolder::check(const fs::path& path, Overwrite overwrite) {
  if (!fs::is_directory(path)) return;
  const std::vector<fs::path> old = written_files(path);
  if (old.empty()) return;
  if (overwrite == Overwrite::replace) {
    if (is_run_record(path / "run.json")) return;
    throw ResultsExist(
        fmt::format("{}: the folder holds {}, but no run.json of Crampon: it may be somebody else's, and is left alone; "
                    "choose another folder or remove it by hand",
                    path.string(), old.front().lexically_relative(path).string()));
  }
  throw ResultsExist(fmt::format("{}: the folder already holds results ({} files, such as {}); choose another folder or say --force",
                                 path.string(), old.size(), old.front().lexically_relative(path).string()));
}

ResultsFolder ResultsFolder::create(const fs::path& path, Overwrite overwrite) {
  check(path, overwrite);
  if (fs::is_directory(path)) {
    std::error_code code;
    std::vector<fs::path> old = written_files(path);
    if (!old.empty()) {
      const std::vector<fs::path> pictures = drawn_pictures(path);
      old.insert(old.end(), pictures.begin(), pictures.end());
    }
    for (const fs::path& file : old)
      if (!fs::remove(file, code) && code) fail(file, "remove", code);
    fs::remove(path / "pictures", code);
    for (const char* series : series_names) fs::remove(path / series, code);  // stays when something else is in it
  }
  create_folder(path);
  return ResultsFolder(path);
}

ResultsFolder ResultsFolder::open(const fs::path& path) {
  if (!fs::is_directory(path)) throw std::runtime_error(fmt::format("{}: no such results folder", path.string()));
  if (written_files(path).empty()) throw std::runtime_error(fmt::format("{}: the folder holds no results", path.string()));
  return ResultsFolder(path);
}

template <class Frame>
void ResultsFolder::write_frame(PvdSeries& series, const char* name, Frame frame, Precision precision) {
  create_folder(path_ / name);
  const std::string file = fmt::format("{}/{}", name, frame_name(name, series.entries().size()));
  const double time = frame.time;
  write_vtp(path_ / file, std::move(frame), precision);
  series.append(time, file);
}

void ResultsFolder::write_particles(PointFrame frame, Precision precision) {
  write_frame(particles_, "particles", std::move(frame), precision);
}
void ResultsFolder::write_cracks(CrackFrame frame, Precision precision) { write_frame(cracks_, "cracks", std::move(frame), precision); }
void ResultsFolder::write_grid(PointFrame frame, Precision precision) { write_frame(grid_, "grid", std::move(frame), precision); }
void ResultsFolder::write_resolved_input(std::string_view text) { write_file(resolved_input(), text); }

namespace {
std::vector<PvdEntry> frames_of(const fs::path& series) { return fs::exists(series) ? read_pvd(series) : std::vector<PvdEntry>{}; }
}  // namespace

std::vector<PvdEntry> ResultsFolder::particle_frames() const { return frames_of(particles_series()); }
std::vector<PvdEntry> ResultsFolder::crack_frames() const { return frames_of(cracks_series()); }
std::vector<PvdEntry> ResultsFolder::grid_frames() const { return frames_of(grid_series()); }

}  // namespace crampon

#include "crampon/output/results_folder.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "crampon/output/file.hpp"
#include "crampon/output/picture_mark.hpp"
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
    if (entry.path().extension() == ".png" && fs::is_regular_file(entry.symlink_status()) && is_marked_picture(entry.path()))
      found.push_back(entry.path());
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

// Sub-folders: of results that come back unless the new run starts, and of results that go.
constexpr const char *set_aside = "replaced.partial", *removed = "removed.partial";
constexpr const char* record_name = "run.json";

void remove_empty_folders(const fs::path& folder) {
  std::error_code ignored;  // one stays when something else is in it
  for (const char* name : {"particles", "cracks", "grid", "pictures", ""}) fs::remove(folder / name, ignored);
}

// Moves files, given relative to both folders; a sub-folder is made where there is none.
void move_files(const fs::path& from, const fs::path& to, const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    create_folder((to / file).parent_path());
    std::error_code code;
    fs::rename(from / file, to / file, code);
    if (code) fail(from / file, "move", code);
  }
}

// Relative to the folder, the record of the run last.
std::vector<fs::path> results_in(const fs::path& folder) {
  std::vector<fs::path> files = written_files(folder);
  const std::vector<fs::path> pictures = drawn_pictures(folder);
  files.insert(files.end(), pictures.begin(), pictures.end());
  for (fs::path& file : files) file = file.lexically_relative(folder);
  std::stable_partition(files.begin(), files.end(), [](const fs::path& file) { return file != record_name; });
  return files;
}

}  // namespace

OlderResults::OlderResults(const fs::path& folder) : folder_(folder) {
  if (!fs::is_directory(folder)) return;
  delete_removed();
  files_ = results_in(folder / set_aside);
  put_back();  // what a run left that was killed before it had started
  const std::vector<fs::path> files = written_files(folder).empty() ? std::vector<fs::path>{} : results_in(folder);
  try {
    for (const fs::path& file : files) {
      move_files(folder, folder / set_aside, {file});
      files_.push_back(file);
    }
  } catch (...) {
    move_files(folder / set_aside, folder, files_);
    throw;
  }
  if (!files.empty()) remove_empty_folders(folder);
}

OlderResults::~OlderResults() { put_back(); }

void OlderResults::put_back() noexcept {
  if (files_.empty()) return;
  try {
    // The record leaves last and comes back first: with it aside, all older results are, and what lies here is the new run's.
    if (files_.back() == record_name) {
      for (const fs::path& file : results_in(folder_)) fs::remove(folder_ / file);
    }
    std::reverse(files_.begin(), files_.end());
    move_files(folder_ / set_aside, folder_, files_);
    remove_empty_folders(folder_ / set_aside);
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): they stay where they are, for the next run to find
  }
  files_.clear();
}

void OlderResults::remove() {
  if (files_.empty()) return;
  files_.clear();
  std::error_code code;
  fs::rename(folder_ / set_aside, folder_ / removed, code);  // at once: should the program be killed now, nobody puts back a part of them
  if (code) fail(folder_ / set_aside, "remove", code);
  delete_removed();
}

void OlderResults::delete_removed() {
  for (const fs::path& file : results_in(folder_ / removed)) {
    std::error_code code;
    if (!fs::remove(folder_ / removed / file, code) && code) fail(folder_ / removed / file, "remove", code);
  }
  remove_empty_folders(folder_ / removed);
}

ResultsFolder::ResultsFolder(fs::path path)
    : path_(std::move(path)), particles_(particles_series()), cracks_(cracks_series()), grid_(grid_series()) {}

void ResultsFolder::check(const fs::path& path, Overwrite overwrite) {
  if (!fs::is_directory(path)) return;
  std::vector<fs::path> old = written_files(path);
  if (old.empty()) old = written_files(path / set_aside);  // where a run was killed as it started
  if (old.empty()) return;
  if (overwrite == Overwrite::replace) {
    if (is_run_record(path / "run.json") || is_run_record(path / set_aside / "run.json")) return;
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
  OlderResults older(path);
  ResultsFolder folder = start(older);
  older.remove();
  return folder;
}

ResultsFolder ResultsFolder::start(const OlderResults& older) {
  create_folder(older.folder());
  return ResultsFolder(older.folder());
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

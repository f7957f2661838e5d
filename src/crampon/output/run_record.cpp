#include "crampon/output/run_record.hpp"

#include <sys/resource.h>

#include <charconv>
#include <ctime>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "crampon/output/file.hpp"

#ifndef CRAMPON_ISA_NAME
#define CRAMPON_ISA_NAME "baseline"
#endif

namespace crampon {
namespace {

using Json = nlohmann::ordered_json;  // the file keeps the order a reader expects

// JSON has no NaN: it is written as null.
double number(const Json& json, const char* key) {
  const Json& entry = json.at(key);
  return entry.is_null() ? std::numeric_limits<double>::quiet_NaN() : entry.get<double>();
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

}  // namespace

RunRecord describe_program() {
  RunRecord record;
  record.status = "running";
  record.version = CRAMPON_VERSION;
#if defined(__clang__)
  record.compiler = "clang " __clang_version__;
#else
  record.compiler = "g++ " __VERSION__;
#endif
  record.instruction_set = CRAMPON_ISA_NAME;
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  record.started.assign(text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc));
  return record;
}

double used_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);  // Linux counts in kB
}

void write_run_record(const std::filesystem::path& path, const RunRecord& r) {
  Json phases = Json::array();
  for (const RunRecord::Phase& phase : r.phases) phases.push_back({{"name", phase.name}, {"seconds", phase.seconds}});
  const Json json{{"program", "Crampon"},
                  {"version", r.version},
                  {"compiler", r.compiler},
                  {"instruction_set", r.instruction_set},
                  {"status", r.status},
                  {"started", r.started},
                  {"input", r.input},
                  {"title", r.title},
                  {"threads", r.threads},
                  {"particles", r.particles},
                  {"steps", r.steps},
                  {"time_step_s", r.time_step},
                  {"end_time_s", r.end_time},
                  {"wall_seconds", r.wall_seconds},
                  {"cpu_seconds", r.cpu_seconds},
                  {"particle_steps_per_second", r.particle_steps_per_second},
                  {"peak_memory_bytes", r.peak_memory_bytes},
                  {"state_hash", fmt::format("{:016x}", r.state_hash)},
                  {"phases", std::move(phases)},
                  {"notes", r.notes}};
  // A title or path need not be UTF-8; a replaced character is better than no record.
  write_file(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

RunRecord read_run_record(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  try {
    const Json json = Json::parse(text);
    RunRecord r;
    r.version = json.at("version").get<std::string>();
    r.compiler = json.at("compiler").get<std::string>();
    r.instruction_set = json.at("instruction_set").get<std::string>();
    r.status = json.at("status").get<std::string>();
    r.started = json.at("started").get<std::string>();
    r.input = json.at("input").get<std::string>();
    r.title = json.at("title").get<std::string>();
    r.threads = json.at("threads").get<int>();
    r.particles = json.at("particles").get<std::int64_t>();
    r.steps = json.at("steps").get<std::int64_t>();
    r.time_step = number(json, "time_step_s");
    r.end_time = number(json, "end_time_s");
    r.wall_seconds = number(json, "wall_seconds");
    r.cpu_seconds = number(json, "cpu_seconds");
    r.particle_steps_per_second = number(json, "particle_steps_per_second");
    r.peak_memory_bytes = number(json, "peak_memory_bytes");
    const std::string hash = json.at("state_hash").get<std::string>();
    const auto [end, code] = std::from_chars(hash.data(), hash.data() + hash.size(), r.state_hash, 16);
    if (code != std::errc() || end != hash.data() + hash.size()) throw std::runtime_error("state_hash is no hexadecimal number");
    for (const Json& phase : json.at("phases")) r.phases.push_back({phase.at("name").get<std::string>(), number(phase, "seconds")});
    r.notes = json.at("notes").get<std::vector<std::string>>();
    return r;
  } catch (const std::exception& e) {
    throw std::runtime_error(fmt::format("{}: damaged run record: {}", path.string(), e.what()));
  }
}

bool is_run_record(const std::filesystem::path& path) {
  // By text: a record that was cut short is one too.
  return std::filesystem::is_regular_file(path) && read_file(path).find("\"program\": \"Crampon\"") != std::string::npos;
}

}  // namespace crampon

#include <cstdlib>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "crampon/core/closest_name.hpp"
#include "crampon/output/run_record.hpp"

namespace crampon::app {
namespace {

/// CLI11's own says the largest number there is in 309 digits.
const CLI::Validator positive(
    [](std::string& text) {
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      return end != text.c_str() && *end == '\0' && value > 0 ? std::string() : text + " is not a positive number";
    },
    "");

constexpr const char* examples = R"(Examples:
  crampon init crack                     write crack.toml, a commented input to start from
  crampon validate crack.toml            check it and tell what would run
  crampon run crack.toml                 run it; results in crack.results
  crampon run crack.toml --set time.courant=0.2 -o finer.results -j 4
  crampon check crack.results            measured beside expected
  crampon draw crack.results --quantity stress_yy --magnify 20
  crampon draw crack.results --history kinetic_energy strain_energy

Exit codes: 0 done, 1 an expected number missed, 2 wrong input or usage, 3 the run stopped, 4 system error, 130 interrupted.)";

/// CLI11 tells nothing about a misspelt subcommand, so the first word that is no option is looked up before it parses.
void check_subcommand(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) names.push_back(sub->get_name());
  const std::string word = argv[1];
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  std::string advice = suggest_from(word, names);
  if (word.ends_with(".toml")) advice = fmt::format("to run it: crampon run {}", word);
  throw UsageError(fmt::format("no subcommand \"{}\"; {}", word, advice));
}

/// The same for options: the long ones that a subcommand has.
std::string advice_for(const CLI::App& sub, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : sub.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const auto found = closest_name(word.substr(0, word.find('=')), names);
  return found ? fmt::format("did you mean \"{}\"?", *found) : fmt::format("see: crampon {} --help", sub.get_name());
}

void add_settings(CLI::App& sub, std::vector<std::string>& settings, int& threads) {
  sub.add_option("-s,--set", settings, "change an entry of the input, e.g. time.courant=0.2 or body[0].velocity=[1,0]; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  sub.add_option("-j,--threads", threads,
                 "number of threads, one per core at most; left out: one per core. The results are the same for any number")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

}  // namespace

std::string command_name() {
  const char* name = std::getenv("CRAMPON_COMMAND");
  return name != nullptr && *name != '\0' ? name : "crampon";
}

int run_command_line(int argc, const char* const* argv) {
  CLI::App app("Crampon: explicit material point method for solids with explicit cracks.", "crampon");
  app.set_version_flag("--version", fmt::format("crampon {}", describe_program().version));
  app.set_help_flag("-h,--help", "print this help and exit");
  app.footer(examples);
  app.require_subcommand(0, 1);

  RunArguments run;
  CLI::App* sub = app.add_subcommand("run", "run an input file");
  sub->add_option("input", run.input, "input file (TOML)")->required()->type_name("INPUT");
  sub->add_option("-o,--output", run.output, "folder for the results; left out: the input's name with .results, in the present folder")
      ->type_name("DIR");
  add_settings(*sub, run.settings, run.threads);
  sub->add_option("--steps", run.steps, "end after so many steps, to try an input")->type_name("N")->check(positive);
  sub->add_flag("-f,--force", run.force, "replace older results in the folder");
  sub->add_flag("--no-check", run.no_check, "do not compare the results with the [[expect]] entries of the input");
  sub->add_flag("-q,--quiet", run.quiet, "print errors only");
  sub->footer(
      "Exits with 1 when an expected number misses. Example: crampon run crack.toml --set time.end=\"1 ms\" --output longer.results");

  ValidateArguments validate;
  sub = app.add_subcommand("validate", "check an input file and tell what would run");
  sub->add_option("input", validate.input, "input file (TOML)")->required()->type_name("INPUT");
  add_settings(*sub, validate.settings, validate.threads);
  sub->footer("Builds the problem and times a few steps of it; writes nothing.\nExample: crampon validate crack.toml");

  InitArguments init;
  sub = app.add_subcommand("init", "write a commented input file to start from");
  sub->add_option("template", init.name, "left out: list them")->type_name("TEMPLATE");
  sub->add_option("-o,--output", init.output, "file to write; - for standard output; left out: TEMPLATE.toml")->type_name("FILE");
  sub->add_flag("-f,--force", init.force, "replace an existing file");
  sub->footer("Example: crampon init crack -o my_crack.toml");

  InfoArguments info;
  sub = app.add_subcommand("info", "tell what a results folder holds");
  sub->add_option("results", info.results, "results folder")->required()->type_name("RESULTS");
  sub->add_flag("--hash", info.hash, "print only a hash of the last frames as they lie on disk: equal hashes, equal numbers");
  sub->footer("Example: crampon info crack.results");

  DrawArguments draw;
  sub = app.add_subcommand("draw", "draw pictures and plots from a results folder (PNG)");
  sub->add_option("results", draw.results, "results folder")->required()->type_name("RESULTS");
  sub->add_option("-c,--quantity", draw.quantity, "colour by this, e.g. stress_xx, velocity, von_mises, pressure; left out: von_mises")
      ->type_name("NAME");
  CLI::Option* frames = sub->add_option("--frame", draw.frames, "numbers of frames from 0; -1 is the last")->type_name("N");
  CLI::Option* times =
      sub->add_option("--time", draw.times, "the frames nearest to these times, e.g. \"20 us\"")->type_name("T")->excludes(frames);
  sub->add_flag("--all", draw.all, "a picture of every frame, with one colour range")->excludes(frames)->excludes(times);
  sub->add_option("--panel", draw.panel, "one picture of several frames in rows and columns; without --frame or --time evenly spread")
      ->type_name("RxC");
  sub->add_option("--magnify", draw.magnify, "draw displacements this many times larger")->type_name("FACTOR")->check(positive);
  sub->add_option("--range", draw.range, "ends of the colour range, e.g. \"-5 MPa\" \"5 MPa\"")->type_name("LOW HIGH")->expected(2);
  sub->add_flag("--symmetric", draw.symmetric, "colour range symmetric about zero");
  sub->add_option("--window", draw.window, "part to draw, m or with units; of a plot of histories: ends of both axes")
      ->type_name("X0 X1 Y0 Y1")
      ->expected(4);
  sub->add_option("--palette", draw.palette, "uniform, grey or diverging; left out: chosen by the quantity")
      ->type_name("NAME")
      ->check(CLI::IsMember({"uniform", "grey", "diverging"}));
  sub->add_flag("--tip-names", draw.tip_names, "write the names of the tips of cracks beside their marks");
  sub->add_flag("--fringes", draw.fringes, "photoelastic fringes (N03 Eq. 23), in grey");
  sub->add_option("--fringe-constant", draw.fringe_constant, "k_f of the fringes, 1/MPa; left out: 0.0889")->type_name("K");
  CLI::Option* history =
      sub->add_option("--history", draw.history,
                      "plot columns of history.csv over time instead, or \"name [unit] = formula of columns\", in SI; J stands "
                      "for the column J of every tip, and so with all names that have a dot")
          ->type_name("COLUMN")
          ->expected(1, -1);
  sub->add_option("--against", draw.against,
                  "with --history: this column, or formula, along the horizontal axis; crack_length: of each curve that of its crack")
      ->type_name("COLUMN")
      ->needs(history);
  CLI::Option* profile =
      sub->add_option("--profile", draw.profile, "plot the quantity of every particle in --window over x, y or z instead")
          ->type_name("AXIS")
          ->check(CLI::IsMember({"x", "y", "z"}))
          ->excludes(history);
  sub->add_flag("--mean", draw.mean, "with --profile: the mean over the particles in strips one cell wide")->needs(profile);
  sub->add_option("--over", draw.over,
                  "with --profile: a curve drawn over it, \"label = formula of the axis and t\", in SI; may be repeated")
      ->type_name("CURVE")
      ->expected(1)
      ->take_all()
      ->needs(profile);
  sub->add_option("--compare", draw.compare, "with --history: the same columns of these results in the same plot")
      ->type_name("RESULTS")
      ->expected(1, -1);
  sub->add_option("--title", draw.title, "left out: the run's")->type_name("TEXT");
  sub->add_option("--width", draw.width, "of the picture, px")->type_name("PX")->check(CLI::Range(200, 10000));
  sub->add_option("-o,--output", draw.output, "PNG file (a folder when there are several pictures); left out: in RESULTS/pictures")
      ->type_name("PATH");
  sub->footer(
      "Examples:\n  crampon draw crack.results --quantity stress_yy --magnify 20 --time \"15 us\"\n"
      "  crampon draw disks.results --panel 2x2 --quantity velocity\n"
      "  crampon draw disks.results --history kinetic_energy strain_energy -o energy.png\n"
      "  crampon draw crack.results --magnify 30 --tip-names\n"
      "  crampon draw crack.results --history J K_I K_II crack_length\n"
      "  crampon draw crack.results --history J --against crack_length\n"
      "  crampon draw dcb.results --history reaction_y.top --against \"opening [m] = 0.2*time\"\n"
      "  crampon draw hertz.results --profile x --quantity stress_yy --over \"Hertz = -6e7*sqrt(max(0, 1 - (x/1.1e-3)^2))\"");

  CheckArguments check;
  sub = app.add_subcommand("check", "compare results with the [[expect]] entries of their input");
  sub->add_option("results", check.results, "results folder")->required()->type_name("RESULTS");
  sub->add_flag("--partial", check.partial, "for a run that was shortened: entries beyond its end are no misses");
  sub->footer("Exits with 1 when a number misses. Example: crampon check crack.results");

  app.add_subcommand("schema", "print the JSON Schema of input files, for editors");
  app.add_subcommand("reference", "print the reference page of input files (Markdown)");
  app.add_subcommand("quantities", "print what a run writes: particle quantities, history columns (Markdown)");
  for (CLI::App* each : app.get_subcommands([](CLI::App*) { return true; })) each->set_help_flag("-h,--help", "print this help and exit");

  check_subcommand(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // help and version
    const auto chosen = app.get_subcommands();
    const CLI::App& at = chosen.empty() ? app : *chosen.front();
    const auto* extras = dynamic_cast<const CLI::ExtrasError*>(&error);
    const std::vector<std::string> left = extras != nullptr ? app.remaining(true) : std::vector<std::string>{};
    if (!left.empty() && left.front().starts_with("--"))
      throw UsageError(fmt::format("no option \"{}\"; {}", left.front(), advice_for(at, left.front())));
    throw UsageError(fmt::format("{}; see: crampon {}--help", error.what(), chosen.empty() ? "" : at.get_name() + " "));
  }

  if (app.got_subcommand("run")) return run_command(run);
  if (app.got_subcommand("validate")) return validate_command(validate);
  if (app.got_subcommand("init")) return init_command(init);
  if (app.got_subcommand("info")) return info_command(info);
  if (app.got_subcommand("draw")) return draw_command(draw);
  if (app.got_subcommand("check")) return check_command(check);
  if (app.got_subcommand("schema")) return schema_command();
  if (app.got_subcommand("reference")) return reference_command();
  if (app.got_subcommand("quantities")) return quantities_command();
  fmt::print("{}", app.help());
  return exit_ok;
}

}  // namespace crampon::app

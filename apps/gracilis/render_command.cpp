#include "render_command.hpp"

#include "console.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/io/atomic_file.hpp>
#include <gracilis/io/input_file.hpp>
#include <gracilis/io/run/recorded_corrections.hpp>
#include <gracilis/view/pictures/gif.hpp>
#include <gracilis/view/pictures/picture_layout.hpp>
#include <gracilis/view/pictures/run_film.hpp>
#include <gracilis/view/pictures/run_picture.hpp>
#include <gracilis/view/pictures/video.hpp>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace gracilis {

namespace {

struct RenderOptions {
  std::filesystem::path run, out;
  std::vector<std::filesystem::path> compare;
  std::vector<int> frames;
  std::string color_by = "natural", size, title;
  Real turn = 0, tilt = 0;  ///< degrees
  bool transparent = false, gif = false, mp4 = false, arrows = false;
  int rate = 25, step = 1;
  bool without_ramp = false;
  RunPictureOptions picture;
};

/// "1280x720" as pixels of the whole picture.
void set_size(const std::string& text, Picture& picture) {
  if (text.empty()) return;
  int width = 0, height = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &end) != 2 || width < 64 || height < 64 || width > 8192 ||
      height > 8192)
    throw ConfigurationError({"--size", "", "'" + text + "' is no size", "write WIDTHxHEIGHT in pixels, 64 to 8192"});
  const int rows = (static_cast<int>(picture.panels.size()) + picture.columns - 1) / picture.columns;
  picture.panel_width = std::max(1, width / picture.columns);
  picture.panel_height = 1;
  // What is not panels, such as legend and captions, keeps its height.
  const int strips = lay_out(picture).height - rows;
  if (height - strips < 32 * rows)
    throw ConfigurationError({"--size", "", "'" + text + "' leaves no room for the shapes", "make it higher"});
  picture.panel_height = (height - strips) / rows;
}

void check_frames(const std::vector<int>& frames, const RecordedRun& run) {
  for (const int frame : frames) {
    if (frame >= 0 && frame < run.frame_count) continue;
    throw ConfigurationError({"--frames", "", fmt::format("there is no frame {}", frame),
                              fmt::format("the run has frames 0 to {}", run.frame_count - 1)});
  }
}

/// Colors of what a run does not have would say something all the same.
void warn_of_missing(const RecordedRun& run, const RunPictureOptions& options) {
  const std::string folder = run.folder.string();
  const auto largest = [&](const char* measure) {
    const Eigen::MatrixXd values = measure_of(run, measure);
    Real found = 0;
    for (const Real value : values.reshaped())
      if (std::isfinite(value)) found = std::max(found, value);
    return found;
  };
  if (options.color_by == ColorBy::activation && largest("activation") == 0)
    spdlog::warn(
        "{}: has no activation: all muscles are relaxed, and all have the color of 0; `activations` of a scene "
        "says what they do (docs/guide/activations.md)",
        folder);
  if (options.color_by == ColorBy::volume && largest("volume_ratio") == 0)
    spdlog::warn("{}: was not measured: colors of volume say nothing (run it with --metrics light)", folder);
  const bool fibers = options.fibers || options.color_by == ColorBy::fiber_strain;
  const bool any = std::any_of(run.muscles.begin(), run.muscles.end(),
                               [&](const std::string& muscle) { return recorded_fibers(run, muscle, 0).count() > 0; });
  if (fibers && !any) spdlog::warn("{}: has no fibers (run it without --no-fibers)", folder);
}

/// Those of what constraints moved where all runs tell it, or else of forces.
void choose_arrows(const std::vector<RecordedRun>& runs, std::vector<int> frames, RunPictureOptions& chosen) {
  if (!std::all_of(runs.begin(), runs.end(), has_corrections)) {
    chosen.arrow_scale = force_arrow_scale(runs);
    return;
  }
  constexpr int most_frames = 12;  // of a film, whose arrows all have one scale
  if (frames.empty()) frames = spread_frames(runs[0].frame_count, most_frames);
  const std::vector<std::string>& muscles = chosen.muscles.empty() ? runs[0].muscles : chosen.muscles;
  chosen.corrections = correction_arrow_size(runs[0], muscles, frames, RunPainter(runs[0], chosen).extent());
}

int render(const RenderOptions& options) {
  std::vector<RecordedRun> runs = {open_recorded_run(options.run)};
  for (const std::filesystem::path& folder : options.compare) runs.push_back(open_recorded_run(folder));
  check_frames(options.frames, runs[0]);
  RunPictureOptions chosen = options.picture;
  const auto& scales = color_scales();
  chosen.color_by = static_cast<ColorBy>(
      std::find_if(scales.begin(), scales.end(), [&](const ColorScale& s) { return s.name == options.color_by; }) -
      scales.begin());
  chosen.turn = radians(options.turn), chosen.tilt = radians(options.tilt);
  for (const RecordedRun& run : runs) warn_of_missing(run, chosen);
  if (chosen.bones == std::vector<std::string>{"none"}) chosen.bones.clear(), chosen.without_bones = true;
  if (options.arrows) choose_arrows(runs, options.frames, chosen);
  std::vector<RunPainter> painters;
  for (const RecordedRun& run : runs) painters.emplace_back(run, chosen);

  const std::string extension = lower_case_extension(options.out);
  const bool gif = options.gif || extension == ".gif", film = gif || options.mp4 || extension == ".mp4";
  if (!film && extension != ".png") {
    throw ConfigurationError(
        {options.out.string(), "", "is no kind of picture that can be written", "name a .png, .gif or .mp4 file"});
  }
  create_folder_of(options.out);
  const int first = options.without_ramp ? std::min(runs[0].first_motion_frame, runs[0].frame_count - 1) : 0;
  if (!film) {
    Picture picture =
        run_picture(runs, painters, options.frames.empty() ? telling_frames(runs[0], first) : options.frames, chosen);
    picture.title = options.title;
    set_size(options.size, picture);
    write_png(options.out, PictureDrawer().draw(picture, options.transparent));
  } else {
    RunFilm frames(runs, painters, chosen, first, options.step, [&](Picture& picture) {
      picture.title = options.title;
      set_size(options.size, picture);
    });
    Progress progress(0, frames.count() - 1);
    int drawn = 0;
    const auto image = [&](int i) {
      progress.show(drawn++);
      return frames.image(i);
    };
    gif ? write_gif(options.out, frames.count(), options.rate, image)
        : write_video(options.out, frames.count(), options.rate, image);
  }
  fmt::print("{}\n", options.out.string());
  return static_cast<int>(ExitCode::done);
}

}  // namespace

void add_render_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "Draw pictures and films of a run; needs no display");
  command->add_option("RUN", options->run, "Run folder")->required();
  command->add_option("--out", options->out, "File to write: .png, or .gif or .mp4 for a film of all frames")
      ->required();
  command
      ->add_option("--view", options->picture.view,
                   "From where: anterior, lateral, anteromedial ... (as the run's preview looks)")
      ->check(CLI::IsMember(view_names()));
  command
      ->add_option("--turn", options->turn,
                   "Degrees by which the camera goes on around the subject, counterclockwise seen from above (0)")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--tilt", options->tilt, "Degrees by which it then rises, or below 0 sinks (0)")
      ->check(CLI::Range(-90.0, 90.0));
  command->add_option("--size", options->size, "WIDTHxHEIGHT of the whole picture, pixels (default: 720 per panel)");
  std::vector<std::string> names;
  for (const ColorScale& scale : color_scales()) names.push_back(scale.name);
  command
      ->add_option("--color-by", options->color_by,
                   "What colors tell (natural: nothing, muscles look like muscle; muscle: which one it is)")
      ->check(CLI::IsMember(names));
  command->add_option("--frames", options->frames, "Frames side by side, as in 0,45,90 (capture, half way, farthest)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--compare", options->compare, "Another run, below (or beside, for one frame); may be repeated")
      ->allow_extra_args(false);
  command->add_option("--muscles", options->picture.muscles, "Show these only; names separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--bones", options->picture.bones, "Show these bones only; names separated by commas, or none")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--hide", options->picture.hidden, "Muscles and bones that are not shown")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--focus", options->picture.focus,
                      "The muscle or bone that fills the picture, or an end: NAME:origin, NAME:insertion");
  command->add_option("--zoom", options->picture.zoom, "How many times larger, 0.1 to 50 (1)")
      ->check(CLI::Range(0.1, 50.0));
  command->add_option("--opacity", options->picture.opacity, "Of muscles, 0.05 to 1")->check(CLI::Range(0.05, 1.0));
  command->add_flag("--fibers", options->picture.fibers, "Show fibers inside muscles that one sees through");
  command->add_flag(
      "--arrows", options->arrows,
      "Show what constraints moved (runs with --corrections), or the forces at muscles' ends (runs by tissue)");
  command->add_option("--title", options->title, "A line above");
  command->add_flag("--transparent", options->transparent, "No background (.png)");
  command->add_flag("--gif", options->gif, "A film as .gif, whatever the file is called");
  command->add_flag("--mp4", options->mp4, "A film as .mp4; needs ffmpeg");
  command->add_option("--rate", options->rate, "Images per second of a film, 1 to 50")->check(CLI::Range(1, 50));
  command->add_option("--step", options->step, "Every which frame goes into a film")->check(CLI::Range(1, 1000));
  command->add_flag("--no-ramp", options->without_ramp, "Leave out the frames between the capture pose and the motion");
  command->callback([&chosen, options] { chosen = [options] { return render(*options); }; });
}

}  // namespace gracilis

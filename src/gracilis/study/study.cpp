#include <gracilis/study/study.hpp>

#include <gracilis/core/shell_word.hpp>
#include <gracilis/io/scene/demo_scene.hpp>

#include <fmt/format.h>

namespace gracilis {

std::filesystem::path scene_file(const Study& study, const StudyRun& run) {
  if (builtin_scene_of(run.scene)) return {};
  return (std::filesystem::absolute(study.file).parent_path() / run.scene).lexically_normal();
}

static std::string joined_names(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

std::string run_definition(const Study& study, const StudyRun& run, const std::string& version) {
  std::string text = "gracilis " + version + "\nscene " + run.scene + "\n";
  if (run.flexion_deg) text += fmt::format("flexion {}\n", *run.flexion_deg);
  for (const std::string& word : run.set) text += "set " + word + "\n";
  if (!study.only.empty()) text += "only " + joined_names(study.only) + "\n";
  const StudyRecording& recording = study.recording;
  return text + fmt::format("metrics {}\nfibers {}\nramps {}\narms {}\npictures {}\nevery {}\nlayout {}\n",
                            name_of(recording.measures), recording.fibers, recording.ramps, recording.arms,
                            recording.pictures, recording.every, name_of(recording.layout));
}

std::string command_alone(const Study& study, const StudyRun& run) {
  std::string text = "gracilis ";
  if (const std::filesystem::path file = scene_file(study, run); !file.empty())
    text += "run " + shell_word(file.string());
  else
    text += run.scene == "demo" ? "demo" : "demo elbow";
  if (run.flexion_deg) text += fmt::format(" --flexion {}", *run.flexion_deg);
  for (const std::string& word : run.set) text += " --set " + shell_word(word);
  if (!study.only.empty()) text += " --only " + shell_word(joined_names(study.only));
  if (!study.data.empty()) text += " --data " + shell_word(study.data.string());
  const StudyRecording& recording = study.recording;
  if (recording.measures != MeasureLevel::full) text += " --metrics " + name_of(recording.measures);
  if (!recording.fibers) text += " --no-fibers";
  if (!recording.ramps) text += " --no-ramp";
  if (recording.arms) text += " --arms";
  if (recording.every > 1) text += fmt::format(" --every {}", recording.every);
  text += " --layout " + name_of(recording.layout);
  return text + " --out " + shell_word(run.name);
}

std::string name_of(StudyOutcome::Statistic statistic) {
  switch (statistic) {
    case StudyOutcome::Statistic::largest:
      return "largest";
    case StudyOutcome::Statistic::smallest:
      return "smallest";
    case StudyOutcome::Statistic::mean:
      return "mean";
    case StudyOutcome::Statistic::last:
      return "last";
  }
  return "";
}

}  // namespace gracilis

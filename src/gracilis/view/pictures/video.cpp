#include <gracilis/view/pictures/video.hpp>

#include <gracilis/core/errors.hpp>
#include <gracilis/core/shell_word.hpp>
#include <gracilis/io/atomic_file.hpp>

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace gracilis {

void write_video(const std::filesystem::path& path, int count, int frames_per_second,
                 const std::function<PixelImage(int)>& image) {
  if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0)
    throw Error(ExitCode::unsupported,
                path.string() + ": there is no ffmpeg (apt-get install ffmpeg, or write a .gif)");
  write_file_atomically(path, [&](const std::filesystem::path& temporary) {
    std::signal(SIGPIPE, SIG_IGN);
    std::FILE* pipe = nullptr;
    bool sent = true;
    for (int i = 0; i < count && sent; ++i) {
      const PixelImage now = image(i);
      if (i == 0) {
        // H.264 wants even sizes; players want 4:2:0.
        const std::string command = fmt::format(
            "ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgba -s {}x{} -r {} -i - -vf "
            "'pad=ceil(iw/2)*2:ceil(ih/2)*2' "
            "-c:v libx264 -crf 18 -pix_fmt yuv420p -movflags +faststart {}",
            now.width, now.height, frames_per_second, shell_word("file:" + temporary.string()));
        pipe = popen(command.c_str(), "w");
        if (!pipe) break;
      }
      sent = std::fwrite(now.rgba.data(), 1, now.rgba.size(), pipe) == now.rgba.size();
    }
    if (!pipe || pclose(pipe) != 0 || !sent)
      throw InputError({path.string(), "", "ffmpeg could not write it", "see what ffmpeg says above, or write a .gif"});
  });
}

}  // namespace gracilis

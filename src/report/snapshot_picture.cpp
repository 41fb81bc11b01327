#include "snapshot_picture.hpp"

#include <geodrop/base/error.hpp>

#include <algorithm>
#include <chrono>
#include <deque>

#include "base/atomic_file.hpp"
#include "base/nearest_name.hpp"
#include "files/read_frames.hpp"
#include "picture_page.hpp"
#include "picture_pixels.hpp"
#include "plot/chart.hpp"

namespace geodrop {
namespace {

namespace fs = std::filesystem;

/// A file of pixels beside the picture, which goes with its owner.
class PixelFile {
 public:
  PixelFile(fs::path path, const std::string& pixels) : path_(std::move(path)) { write_file_atomically(path_, pixels); }
  PixelFile(const PixelFile&) = delete;
  PixelFile& operator=(const PixelFile&) = delete;
  ~PixelFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A page for gnuplot and the files that it reads.
struct Page {
  PictureLayout layout;
  std::string text;
};
Page page_of(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options, const std::string& stem,
             std::deque<PixelFile>& files) {
  const PictureContent content = content_of(scene, snapshot, options);
  Page page{layout_of(options.window ? *options.window : whole_extent(scene, snapshot), content), ""};
  std::vector<fs::path> paths;
  for (std::size_t v = 0; v < content.views.size(); ++v) {
    files.emplace_back(stem + "." + std::to_string(v) + ".pixels",
                       pixels_of(scene, content.views[v], page.layout.panels[v]));
    paths.push_back(fs::absolute(files.back().path()));
  }
  page.text = page_text(scene, snapshot.t, content, page.layout, paths);
  return page;
}

/// Window of the first frame, scales of the first, the middle and the last one together.
PictureOptions options_for_all(const Scene& scene, const fs::path& directory, const std::vector<std::size_t>& frames,
                               PictureOptions options) {
  const PictureOptions given = options;
  for (const std::size_t index : {frames.front(), frames[frames.size() / 2], frames.back()}) {
    const Snapshot snapshot = read_frame(directory, index);
    options.field = picture_field(snapshot, options);
    check_picture(scene, snapshot, options);
    const PictureContent content =
        content_of(scene, snapshot, {options.field, options.membrane, {}, {}, {}, given.cut});
    const auto join = [](std::optional<ValueRange>& range, const std::optional<ColourBar>& bar, bool is_given) {
      if (!bar || is_given) return;
      range = range ? ValueRange{std::min(range->first, bar->range.first), std::max(range->second, bar->range.second)}
                    : bar->range;
    };
    join(options.range, content.field, given.range.has_value());
    join(options.tensions, content.membrane, given.tensions.has_value());
    if (!options.window) options.window = whole_extent(scene, snapshot);
  }
  return options;
}

}  // namespace

void check_picture(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options) {
  const auto refuse = [&](const std::string& option, const std::string& found, const std::string& allowed) {
    throw SceneError("geodrop snapshot", {{{}, option, found, allowed, ProblemSource::elsewhere}});
  };
  if (scene.dimension == 2 && options.cut) refuse("--cut", "a scene of the plane", "a scene in space");
  const auto check = [&](const std::string& option, const std::string& name, const std::vector<std::string>& known) {
    if (std::ranges::find(known, name) == known.end())
      refuse(option, '"' + name + '"', name_advice(name, known, "fields"));
  };
  check("--field", picture_field(snapshot, options), picture_fields(snapshot));
  std::vector<std::string> membrane{"none"};
  const std::vector<std::string> values = value_names(snapshot.membranes.fields);
  membrane.insert(membrane.end(), values.begin(), values.end());
  if (!snapshot.membranes.fields.empty()) check("--membrane", options.membrane, membrane);
}

void draw_snapshot(const Scene& scene, const Snapshot& snapshot, const PictureOptions& options, const fs::path& file) {
  check_picture(scene, snapshot, options);
  std::deque<PixelFile> pixels;
  const Page page = page_of(scene, snapshot, options, file.string(), pixels);
  draw_by_gnuplot(file, [&](const fs::path& picture) {
    return page_opening("pngcairo noenhanced font 'sans,12' background rgb 'white'", page.layout, picture) + page.text +
           "unset output\n";
  });
}

void draw_animation(const Scene& scene, const fs::path& directory, const std::vector<std::size_t>& frames,
                    PictureOptions options, const fs::path& file) {
  constexpr std::chrono::seconds patience_for_each{4};
  options = options_for_all(scene, directory, frames, std::move(options));
  std::deque<PixelFile> pixels;
  draw_by_gnuplot(
      file,
      [&](const fs::path& picture) {
        std::string first, pages;
        for (const std::size_t index : frames) {
          const Page page = page_of(scene, read_frame(directory, index), options,
                                    file.string() + "." + std::to_string(index), pixels);
          if (first.empty())
            first = page_opening("gif noenhanced animate delay 10 loop 0 font 'sans,11'", page.layout, picture);
          pages += page.text;
        }
        return first + pages + "unset output\n";
      },
      patience_for_each * static_cast<int>(frames.size() + 8));
}

}  // namespace geodrop

#include <gracilis/io/input_file.hpp>

#include "build_paths.hpp"
#include "io/test_files.hpp"
#include "view/browser.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace gracilis {

namespace embedded {
extern const std::string_view three_js, orbit_js;
}

/// Parts of the page in the browser (web/page) by themselves: without the program that WebAssembly runs.
class PageParts : public testing::Test {
 protected:
  void SetUp() override {
    if (!Browser::is_there()) GTEST_SKIP() << "there is no /usr/bin/chromium";
    browser_ = &Browser::fresh();
    browser_->set_size(600, 400);
  }

  static std::string part(const std::string& name) {
    return read_text(std::filesystem::path(build_paths::source_folder) / "web" / "page" / name);
  }

  void open(const std::string& body) {
    std::ofstream(folder_.path() / "page.html") << "<!doctype html><meta charset=utf-8>" << body;
    browser_->open(folder_.path() / "page.html");
  }

  nlohmann::json js(const std::string& expression) { return browser_->evaluate(expression); }

  TestFolder folder_;
  Browser* browser_ = nullptr;
};

/// worker.js with a program in the place of the compiled one, which fails as `fails` says and has one coordinate.
class PageWorker : public PageParts {
 protected:
  void SetUp() override {
    PageParts::SetUp();
    if (IsSkipped()) return;
    open("<script type='text/plain' id='worker'>" + part("worker.js") + "</script><script>" + R"js(
const fails = new Set(), sent = [];
const failing = name => { if (fails.has(name)) throw new Error(`${name} fails`); };
const scene = {name: 'one', axes: {}, methods: [{name: 'a'}, {name: 'b'}], coordinates: [{capture: 0}], bones: [],
               muscles: [], bodies: 0, bodyCount: 0};
function program() {
  const memory = {buffer: new ArrayBuffer(65536)};
  let end = 8192;
  new Uint8Array(memory.buffer).set(new TextEncoder().encode(JSON.stringify(scene)), 1024);
  return {memory, _initialize() {}, prepare() {}, show() {}, description: () => 1024, malloc: size => (end += size) - size,
          choose(method) { failing(`choose ${method}`); },
          advance() { failing('advance'); },
          pull(bone, places, values) {
            failing('pull');
            new Float64Array(memory.buffer, values, 1)[0] = 0.03;
            return 1;
          }};
}
const WebAssemblyInItsPlace = {
  async compile() { failing('compile'); return {}; },
  async instantiate() {
    await new Promise(done => setTimeout(done, 20));
    failing('instantiate');
    return {exports: program()};
  },
};
const hear = new Function('WebAssembly', 'postMessage', `let onmessage; ${document.getElementById('worker').textContent}
return data => onmessage({data});`)(WebAssemblyInItsPlace, message => sent.push(message));
const last = kind => sent.filter(each => each.kind === kind).pop();
async function until(isSo) {
  for (let i = 0; i < 200 && !isSo(); ++i) await new Promise(done => setTimeout(done, 10));
  return Boolean(isSo());
}
const isReady = () => sent.length > 0 && sent[sent.length - 1].text === 'ready';
</script>)js");
  }

  bool becomes(const std::string& condition) { return js("until(() => " + condition + ")") == true; }
  void begin() {
    js("void hear({task: 'begin', bytes: null, method: 0})");
    ASSERT_TRUE(becomes("isReady()"));
  }
};

TEST_F(PageWorker, goes_where_it_is_aimed_at_and_where_a_bone_is_pulled) {
  begin();
  js("void hear({task: 'aim', coordinates: [0.05], activations: []})");
  EXPECT_TRUE(becomes("last('frame').coordinates[0] === 0.05 && isReady()"));
  js("void hear({task: 'pull', bone: 0, point: [0, 0, 0], target: [0, 0, 0], looking: [0, 0, 1]})");
  EXPECT_TRUE(becomes("last('frame').coordinates[0] === 0.03 && isReady()"));
  EXPECT_EQ(js("last('aim').coordinates[0]"), 0.03);
}

TEST_F(PageWorker, tells_what_fails_at_the_beginning) {
  for (const std::string what : {"compile", "instantiate", "choose 0"}) {
    js("fails.clear(), fails.add('" + what + "'), sent.splice(0), void hear({task: 'begin', bytes: null, method: 0})");
    EXPECT_TRUE(becomes("last('failure') && last('failure').final")) << what;
    EXPECT_EQ(js("last('failure').text"), what + " fails");
  }
}

TEST_F(PageWorker, takes_another_method_after_one_that_always_fails) {
  begin();
  js("fails.add('choose 0'), fails.add('advance')");
  js("void hear({task: 'aim', coordinates: [0.05], activations: []})");
  ASSERT_TRUE(becomes("last('failure') && last('failure').final"));
  js("fails.clear(), void hear({task: 'choose', method: 1})");
  EXPECT_TRUE(becomes("isReady() && last('frame').method === 1"));
  js("void hear({task: 'aim', coordinates: [0.05], activations: []})");
  EXPECT_TRUE(becomes("last('frame').coordinates[0] === 0.05 && isReady()"));
}

TEST_F(PageWorker, follows_an_aim_that_comes_while_it_starts_again) {
  for (const std::string what : {"advance", "pull"}) {
    js("fails.clear(), void sent.splice(0)");
    begin();
    js("fails.add('" + what +
       "'), void hear({task: 'aim', coordinates: [0.05], activations: []}), "
       "void hear({task: 'pull', bone: 0, point: [0, 0, 0], target: [0, 0, 0], looking: [0, 0, 1]})");
    ASSERT_TRUE(becomes("last('failure')")) << what;
    js("fails.clear(), void hear({task: 'aim', coordinates: [0.07], activations: []})");
    EXPECT_TRUE(becomes("last('frame').coordinates[0] === 0.07 && isReady()")) << what;
    EXPECT_EQ(js("Boolean(last('failure').final)"), false);
  }
}

/// pulling.js and the orbit, on a view of 400 pixels (0.2 m) with a bone of 50 mm in its middle.
class PagePulling : public PageParts {
 protected:
  void SetUp() override {
    PageParts::SetUp();
    if (IsSkipped()) return;
    open(
        "<style>* { margin: 0 } canvas { width: 400px; height: 400px }</style><div "
        "id='view'><canvas></canvas></div><script>" +
        std::string(embedded::three_js) + "</script><script>" + std::string(embedded::orbit_js) + part("pulling.js") +
        R"js(
const canvas = document.querySelector('canvas'), pulls = [];
canvas.setPointerCapture = () => {};  // which takes no pointers that are none
const orbit = new Orbit(canvas, new THREE.Vector3(0, 1, 0), () => {});
orbit.halfHeight = 0.1;
const camera = new THREE.OrthographicCamera(-0.1, 0.1, 0.1, -0.1, 0.01, 10);
camera.position.z = 1;
camera.updateMatrixWorld();
const mesh = new THREE.Mesh(new THREE.BoxBufferGeometry(0.05, 0.05, 0.05), new THREE.MeshBasicMaterial());
mesh.updateMatrixWorld();
new Pulling(document.getElementById('view'), {canvas, orbit}, {bones: [{mesh, body: 1}], muscles: [], camera},
            (bone, point, target) => pulls.push(target));
function touch(what, pointerId, clientX, clientY) {
  canvas.dispatchEvent(new PointerEvent('pointer' + what, {pointerId, clientX, clientY, button: 0, buttons: 1, bubbles: true}));
}
</script>)js");
  }
};

TEST_F(PagePulling, a_second_finger_lets_go_of_the_bone_and_both_zoom_and_shift) {
  js("touch('down', 1, 200, 200), touch('move', 1, 220, 200)");
  EXPECT_EQ(js("pulls.length"), 1);
  EXPECT_NEAR(js("pulls[0][0]").get<double>(), 0.01, 1e-6);
  js("touch('down', 2, 320, 200), touch('move', 1, 200, 200), touch('move', 2, 280, 200)");
  EXPECT_EQ(js("pulls.length"), 1) << "the first one pulls no more";
  EXPECT_NEAR(js("orbit.halfHeight").get<double>(), 0.1 * 100 / 80, 1e-9);
  EXPECT_GT(js("orbit.center.length()").get<double>(), 0.001) << "their middle went 30 pixels to the left";
  js("touch('up', 1, 200, 200), touch('up', 2, 280, 200), touch('down', 3, 200, 200), touch('move', 3, 200, 220)");
  EXPECT_EQ(js("pulls.length"), 2) << "one finger pulls again";
}

TEST_F(PagePulling, a_second_finger_on_a_bone_takes_no_hold_of_it) {
  js("touch('down', 1, 20, 200), touch('down', 2, 200, 200), touch('move', 2, 220, 200)");
  EXPECT_EQ(js("pulls.length"), 0);
  EXPECT_EQ(js("orbit.pointers.size"), 2);
}

}  // namespace gracilis

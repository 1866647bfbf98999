#include "browser.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace gracilis {

using nlohmann::json;

static constexpr int patience = 60'000;  // milliseconds for one answer, on a busy machine without a graphics card
static constexpr const char* program = "/usr/bin/chromium";

bool Browser::is_there() { return access(program, X_OK) == 0; }

Browser::Browser(int width, int height) {
  signal(SIGPIPE, SIG_IGN);
  char profile[] = "/tmp/gracilis_browser_XXXXXX";
  profile_ = mkdtemp(profile);
  int commands[2], answers[2];
  if (pipe(commands) != 0 || pipe(answers) != 0) throw std::runtime_error("no pipes");
  process_ = fork();
  if (process_ == 0) {
    // The protocol's pipes are descriptors 3 (commands) and 4 (answers). First out of each other's way.
    const int in = fcntl(commands[0], F_DUPFD, 10), out = fcntl(answers[1], F_DUPFD, 10),
              quiet = ::open("/dev/null", O_RDWR);
    dup2(in, 3), dup2(out, 4), dup2(quiet, 1), dup2(quiet, 2);
    setpgid(0, 0);
    const std::string size = "--window-size=" + std::to_string(width) + "," + std::to_string(height);
    const std::string folder = "--user-data-dir=" + profile_.string();
    execl(program, program, "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--hide-scrollbars",
          "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking",
          "--no-first-run", size.c_str(), folder.c_str(), "about:blank", nullptr);
    _exit(127);
  }
  close(commands[0]), close(answers[1]);
  to_ = commands[1], from_ = answers[0];
  const json target = call("Target.createTarget", {{"url", "about:blank"}});
  session_ = call("Target.attachToTarget", {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
  for (const char* domain : {"Page", "Runtime", "Log", "Network"}) call(std::string(domain) + ".enable");
}

Browser& Browser::fresh() {
  static Browser browser(1400, 900);
  browser.forget();
  return browser;
}

void Browser::forget() {
  call("Emulation.clearDeviceMetricsOverride");
  load("about:blank");
  mouse("mouseMoved", 0, 0, 0);
  complaints.clear(), requests.clear();
}

Browser::~Browser() {
  close(to_), close(from_);
  kill(-process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  std::error_code ignored;
  std::filesystem::remove_all(profile_, ignored);
}

json Browser::read_message() {
  std::size_t end;
  while ((end = pending_.find('\0')) == std::string::npos) {
    pollfd ready{from_, POLLIN, 0};
    char buffer[65536];
    const ssize_t count = poll(&ready, 1, patience) == 1 ? read(from_, buffer, sizeof buffer) : 0;
    if (count <= 0) throw std::runtime_error("the browser does not answer");
    pending_.append(buffer, static_cast<std::size_t>(count));
  }
  const json message = json::parse(pending_.substr(0, end));
  pending_.erase(0, end + 1);
  return message;
}

void Browser::note(const json& event) {
  const std::string method = event.value("method", "");
  if (method.empty()) return;
  const json& parameters = event["params"];
  if (method == "Page.loadEventFired") loaded_ = true;
  if (method == "Runtime.exceptionThrown") complaints.push_back(parameters["exceptionDetails"].dump());
  if (method == "Log.entryAdded" && parameters["entry"]["level"] != "verbose" && parameters["entry"]["level"] != "info")
    complaints.push_back(parameters["entry"].dump());
  if (method == "Runtime.consoleAPICalled" && (parameters["type"] == "error" || parameters["type"] == "warning"))
    complaints.push_back(parameters["args"].dump());
  if (method == "Network.requestWillBeSent") {
    const std::string address = parameters["request"]["url"];
    if (address != address_ && !address.starts_with("data:")) requests.push_back(address);
  }
}

json Browser::call(const std::string& method, const json& parameters) {
  json command = {{"id", ++calls_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) command["sessionId"] = session_;
  const std::string text = command.dump() + '\0';
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = write(to_, text.data() + sent, text.size() - sent);
    if (count <= 0) throw std::runtime_error("the browser does not listen");
    sent += static_cast<std::size_t>(count);
  }
  for (;;) {
    const json message = read_message();
    note(message);
    if (message.value("id", 0) != calls_) continue;
    if (message.contains("error")) throw std::runtime_error(method + ": " + message["error"].dump());
    return message["result"];
  }
}

void Browser::set_size(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::open(const std::filesystem::path& file) { load("file://" + std::filesystem::absolute(file).string()); }

void Browser::load(const std::string& address) {
  address_ = address;
  loaded_ = false;
  call("Page.navigate", {{"url", address_}});
  while (!loaded_) note(read_message());
}

json Browser::evaluate(const std::string& expression) {
  const json result =
      call("Runtime.evaluate", {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (result.contains("exceptionDetails")) throw std::runtime_error(expression + ": " + result.dump());
  return result["result"].value("value", json());
}

void Browser::press(const std::string& key) {
  json event = {{"type", "keyDown"}, {"key", key}};
  if (key.size() == 1) event["text"] = key;
  call("Input.dispatchKeyEvent", event);
  event["type"] = "keyUp";
  call("Input.dispatchKeyEvent", event);
}

void Browser::mouse(const std::string& type, double x, double y, int buttons) {
  json event = {{"type", type}, {"x", x}, {"y", y}, {"buttons", buttons}};
  if (type != "mouseMoved") event["button"] = "left", event["clickCount"] = 1;
  call("Input.dispatchMouseEvent", event);
}

void Browser::click(double x, double y) { drag(x, y, x, y); }

void Browser::drag(double x, double y, double to_x, double to_y) {
  mouse("mouseMoved", x, y, 0);
  mouse("mousePressed", x, y, 1);
  if (x != to_x || y != to_y) mouse("mouseMoved", to_x, to_y, 1);
  mouse("mouseReleased", to_x, to_y, 0);
}

void Browser::wheel(double x, double y, double delta) {
  call("Input.dispatchMouseEvent", {{"type", "mouseWheel"}, {"x", x}, {"y", y}, {"deltaX", 0}, {"deltaY", delta}});
}

static std::string from_base64(const std::string& text) {
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    const std::size_t digit = std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    if (digit == std::string::npos) break;
    bits = bits << 6 | static_cast<unsigned>(digit);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

void Browser::screenshot(const std::filesystem::path& file) {
  std::ofstream(file, std::ios::binary) << from_base64(call("Page.captureScreenshot")["data"]);
}

std::string Browser::print() { return from_base64(call("Page.printToPDF")["data"]); }

}  // namespace gracilis

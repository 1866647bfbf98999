#include "simulation_handle.hpp"

#include "arrays.hpp"
#include "asked_step.hpp"
#include "errors.hpp"
#include "live_state.hpp"
#include "scene_handle.hpp"

#include <gracilis/core/errors.hpp>
#include <gracilis/core/state_hash.hpp>
#include <gracilis/geometry/measures.hpp>
#include <gracilis/io/suggestions.hpp>

#include <pybind11/stl.h>

#include <fmt/format.h>

#include <optional>

namespace py = pybind11;

namespace gracilis::python {

namespace {

using State = std::shared_ptr<LiveState>;

/// gracilis.Muscle: one muscle of a simulation, in its present frame.
struct LiveMuscle {
  State state;
  std::size_t number = 0;

  const Muscle& muscle() const { return state->scene().muscles[number]; }
  const Points& points() const { return state->frame().muscles[number].points; }
};

/// gracilis.Bone, likewise.
struct LiveBone {
  State state;
  std::size_t number = 0;

  const Bone& bone() const { return state->scene().bones[number]; }
  const RigidTransform& moved() const { return state->frame().pose.bodies[static_cast<std::size_t>(bone().body)]; }
};

struct Activations {
  State state;
};

struct SimulationHandle {
  State state;
  py::object muscles, bones;  ///< by name; they hold the state, not this
};

struct CheckpointHandle {
  State of;
  Checkpoint checkpoint;
};

std::size_t muscle_named(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Muscle& muscle : scene.muscles) names.push_back(muscle.name);
  for (std::size_t m = 0; m < names.size(); ++m)
    if (names[m] == name) return m;
  throw ConfigurationError({"", "", "there is no muscle '" + name + "'", suggestion(name, names)});
}

void advance(const SimulationHandle& self, const py::object& pose, const py::dict& radians,
             std::optional<Real> time_step) {
  LiveState& state = *self.state;
  const AskedStep asked = asked_step(state, pose, radians, time_step);
  state.advance(asked.pose, asked.time_step);
  state.coordinates = asked.pose.coordinates;
  for (std::size_t m = 0; m < state.activations.size(); ++m)
    if (state.planned[m]) state.activations[m] = asked.pose.activations[m];
}

py::dict coordinates_of(const SimulationHandle& self, bool in_degrees) {
  return coordinates_by_name(self.state->scene(), self.state->frame().pose.coordinates, in_degrees);
}

template <class Part, class Live>
py::object by_name(const State& state, const std::vector<Part>& parts, Live) {
  py::dict named;
  for (std::size_t i = 0; i < parts.size(); ++i) named[py::str(parts[i].name)] = Live{state, i};
  return py::module_::import("types").attr("MappingProxyType")(named);
}

SimulationHandle simulation_of(const SceneHandle& scene, const std::string& method, const py::kwargs& settings) {
  const auto state = std::make_shared<LiveState>(*changed(scene, method, settings));
  return {state, by_name(state, state->scene().muscles, LiveMuscle{}),
          by_name(state, state->scene().bones, LiveBone{})};
}

std::uint64_t hash_of_state(const SimulationHandle& self) {
  std::uint64_t hash = hash_seed;
  for (const MuscleShape& shape : self.state->frame().muscles) hash = hash_of(shape.points, hash);
  return hash;
}

py::list fibers_of(const LiveMuscle& self) {
  const auto all = self.state->fibers();
  const Polylines& lines = (*all)[self.number].lines;
  const py::capsule owner = keeper(all);
  py::list fibers;
  for (Index i = 0; i < lines.count(); ++i)
    fibers.append(
        view(lines.points.data() + 3 * static_cast<std::ptrdiff_t>(lines.begin(i)), {lines.size(i), 3}, owner));
  return fibers;
}

py::array fiber_lengths_of(const LiveMuscle& self) {
  const auto all = self.state->fibers();
  const std::vector<Real>& lengths = (*all)[self.number].lengths;
  return view(lengths.data(), {static_cast<py::ssize_t>(lengths.size())}, keeper(all));
}

py::array depths_of(const LiveMuscle& self) {
  const auto all = self.state->depths();
  const std::vector<float>& depths = (*all)[self.number];
  return view(depths.data(), {static_cast<py::ssize_t>(depths.size())}, keeper(all));
}

py::array moved_vertices(const LiveBone& self) {
  const auto moved = std::make_shared<const Points>(self.moved() * self.bone().surface.vertices);
  return rows_view(*moved, keeper(moved));
}

void bind_muscle(py::module_& module) {
  py::class_<LiveMuscle>(module, "Muscle", R"(One muscle of a simulation, in the simulation's present frame.

Arrays are read-only views without a copy. One that is held keeps showing the frame it was asked for in, also when the
simulation goes on or is gone.)")
      .def_property_readonly("name", [](const LiveMuscle& self) { return self.muscle().name; })
      .def_property_readonly(
          "vertices", [](const LiveMuscle& self) { return self.state->vertices(self.number); }, "(n, 3) float64, m")
      .def_property_readonly(
          "faces", [](const LiveMuscle& self) { return rows_view(self.muscle().surface.faces, py::cast(self)); },
          "(m, 3) int32, counter-clockwise seen from outside")
      .def_property_readonly("fibers", &fibers_of, R"(List of (k, 3) float64, m, from origin to insertion.

Where the method does not know fibers itself they follow the surface; making them takes seconds the first time.)")
      .def_property_readonly("fiber_lengths", &fiber_lengths_of, "(f,) float64, m")
      .def_property_readonly(
          "mean_fiber_length", [](const LiveMuscle& self) { return (*self.state->fibers())[self.number].mean_length; },
          "m; 0 without fibers")
      .def_property_readonly(
          "volume", [](const LiveMuscle& self) { return enclosed_volume(self.points(), self.muscle().surface.faces); },
          "m³")
      .def_property_readonly(
          "contact_depth", &depths_of,
          R"((n,) float32, m: how deep each vertex is in whatever bone or other muscle it is deepest in.

Negative where it is apart from all, down to -3 mm.)")
      .def("__repr__", [](const LiveMuscle& self) {
        return fmt::format("<gracilis.Muscle '{}': {} vertices>", self.muscle().name, self.points().cols());
      });
  py::class_<LiveBone>(module, "Bone", "One bone of a simulation, in the simulation's present frame.")
      .def_property_readonly("name", [](const LiveBone& self) { return self.bone().name; })
      .def_property_readonly("vertices", &moved_vertices, "(n, 3) float64, m; moved when it is asked for")
      .def_property_readonly(
          "faces", [](const LiveBone& self) { return rows_view(self.bone().surface.faces, py::cast(self)); },
          "(m, 3) int32")
      .def_property_readonly(
          "transform", [](const LiveBone& self) { return copied(Eigen::MatrixXd(self.moved().matrix())); },
          "(4, 4) float64, from its place in the capture pose to its place now");
}

void bind_activations(py::module_& module) {
  const auto get = [](const Activations& self, const std::string& name) {
    return self.state->activations[muscle_named(self.state->scene(), name)];
  };
  const auto set = [](const Activations& self, const std::string& name, const py::object& value) {
    const std::size_t muscle = muscle_named(self.state->scene(), name);
    const Real activation = number_of(value, name);
    if (!(activation >= 0 && activation <= 1)) refuse(name, "an activation must be from 0 to 1");
    self.state->activations[muscle] = activation;
  };
  py::class_<Activations>(module, "Activations", R"(How active each muscle shall be, 0 to 1, from the next step on.

A step to one of Scene.poses sets those of the muscles that the scene itself drives.)")
      .def("__getitem__", get)
      .def("__setitem__", set)
      .def("__len__", [](const Activations& self) { return self.state->activations.size(); })
      .def("__contains__",
           [](const Activations& self, const std::string& name) {
             const std::vector<Muscle>& muscles = self.state->scene().muscles;
             return std::any_of(muscles.begin(), muscles.end(),
                                [&](const Muscle& muscle) { return muscle.name == name; });
           })
      .def("keys",
           [](const Activations& self) {
             std::vector<std::string> names;
             for (const Muscle& muscle : self.state->scene().muscles) names.push_back(muscle.name);
             return names;
           })
      .def("__iter__", [](const py::object& self) { return py::iter(self.attr("keys")()); })
      .def("update",
           [set](const Activations& self, const py::dict& values) {
             for (const auto& [key, value] : values)
               set(self, py::str(key).cast<std::string>(), py::reinterpret_borrow<py::object>(value));
           })
      .def("__repr__", [](const py::object& self) { return py::repr(py::dict(self)); });
}

}  // namespace

void bind_simulation(py::module_& module) {
  bind_muscle(module);
  bind_activations(module);
  py::class_<CheckpointHandle>(module, "Checkpoint", "Where a simulation can go on from; see Simulation.restore.");
  py::class_<SimulationHandle>(module, "Simulation", R"(A scene that is moved step by step.

method: how muscles deform ('xpbd', 'tissue', 'strings', ...; default: the scene's own). Keywords are settings, as of
load(). Preparing takes a second or more. Several simulations may run in several threads at the same time.)")
      .def(py::init(&simulation_of), py::arg("scene"), py::arg("method") = "")
      .def("advance", &advance, py::arg("pose") = py::none(), py::kw_only(), py::arg("radians") = py::dict(),
           py::arg("time_step") = py::none(), R"(One frame on, to where the coordinates shall be.

pose: degrees (mm for translations) by coordinates' names; those not named stay. Or one of Scene.poses, which brings all
coordinates, its time and the activations of the muscles that the scene drives: then frames have the same bits as those
of a run of the scene. Other muscles are as active as Simulation.activations says.
radians: rad (m) by names; not beside one of Scene.poses. time_step: s since the last frame (1/60; of one of
Scene.poses, its own).

Raises QualityError where a shape stops being finite; the frame is then the last one. Ctrl-C stops it within the frame.)")
      .def(
          "reset", [](const SimulationHandle& self) { self.state->reset(); },
          "Back to the capture pose, all muscles relaxed.")
      .def(
          "checkpoint",
          [](const SimulationHandle& self) {
            return CheckpointHandle{self.state, self.state->checkpoint()};
          },
          "What restore() goes on from.")
      .def(
          "restore",
          [](const SimulationHandle& self, const CheckpointHandle& from) {
            if (from.of != self.state) refuse("checkpoint", "is of another simulation");
            self.state->restore(from.checkpoint);
          },
          py::arg("checkpoint"),
          R"(Back to where checkpoint() was called; what follows has the same bits as it had then.

Takes up to some frames' time (contact remembers more than a shape tells), with the methods tissue and mass-spring that of all
frames since the capture pose.)")
      .def_readonly("muscles", &SimulationHandle::muscles, "name -> Muscle")
      .def_readonly("bones", &SimulationHandle::bones, "name -> Bone")
      .def_property_readonly(
          "activations", [](const SimulationHandle& self) { return Activations{self.state}; },
          "name -> how active the muscle shall be from the next step on, 0 to 1; may be set")
      .def_property_readonly(
          "degrees", [](const SimulationHandle& self) { return coordinates_of(self, true); },
          "name -> the coordinate in the present frame, degrees (mm for translations)")
      .def_property_readonly(
          "radians", [](const SimulationHandle& self) { return coordinates_of(self, false); },
          "name -> the coordinate in the present frame, rad (m for translations)")
      .def_property_readonly(
          "frame", [](const SimulationHandle& self) { return self.state->frame().number; },
          "Number of the present frame; 0 is the capture pose.")
      .def_property_readonly(
          "time", [](const SimulationHandle& self) { return self.state->frame().pose.time; }, "s")
      .def_property_readonly(
          "solver_seconds", [](const SimulationHandle& self) { return self.state->solver_seconds(); },
          "s of the clock that the last advance() spent in the solver; what it took beyond that is Python's.")
      .def_property_readonly("method", [](const SimulationHandle& self) { return self.state->scene().method.name; })
      .def("state_hash", &hash_of_state, "A number that is the same where all vertices have the same bits (FNV-1a).")
      .def("__repr__", [](const SimulationHandle& self) {
        return fmt::format("<gracilis.Simulation of '{}', method {}, frame {}>", self.state->scene().name,
                           self.state->scene().method.name, self.state->frame().number);
      });
}

}  // namespace gracilis::python

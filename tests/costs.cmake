# Read by CTest after the tests of each program: single tests that take long, about seconds of two processors, are begun
# early, so that none is left for one processor at the end.
foreach(test view.ReadmeWalk.every_command_works_and_every_picture_looks_as_it_should
             app.JanakReproduction.springs_come_to_rest_and_short_steps_take_longer)
  set_tests_properties(${test} PROPERTIES COST 60)
endforeach()
foreach(test view.ViewCommand.a_scene_follows_its_sliders_and_tells_what_constraints_moved
             app.CompareCommand.runs_the_builtin_hip_by_several_methods_and_shows_them_side_by_side
             app.FailingCalls.each_is_one_message_leaves_nothing_half_written_and_can_be_resumed
             app.FailingCalls.the_same_holds_for_compact_frames
             app.FiberCommands.activations_reach_the_measures_in_every_way
             app.HavlicekReproduction.has_the_published_parameters_an_active_iliacus_is_the_shorter_and_motions_are_driven
             app.Reproduction.the_hip_in_large_steps_has_a_row_for_every_published_curve)
  set_tests_properties(${test} PROPERTIES COST 30)
endforeach()
foreach(test view.GuideWalk.every_command_works
             view.ViewCommand.a_bone_is_dragged_and_a_click_on_a_muscle_tells_its_numbers
             draft.SceneCommand.a_folder_becomes_a_scene_with_a_picture_that_runs_and_tells_its_guesses)
  set_tests_properties(${test} PROPERTIES COST 15)
endforeach()
# Where no one asked for `long_tests`, CTest has one in their place that says so.
foreach(module app scenarios study)
  set_tests_properties(${module}_long_tests_NOT_BUILT PROPERTIES LABELS long)
endforeach()

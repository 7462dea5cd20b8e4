"""Plans from Python: rows, files and checks equal those of the command."""
import unittest

import floc
import samples

SCENE = samples.SOURCE / "data/scenes/demo.toml"
SMALL = samples.SOURCE / "data/scenes/type1_rolling_small.toml"


class Plans(unittest.TestCase):
    def directory(self):
        path = samples.directory() / self.id().rsplit(".", 1)[1]
        path.mkdir(exist_ok=True)
        return path

    def test_equal_the_command(self):
        plans = floc.plan(SCENE, budget="2h", cores=2, changes={"grains.count": 300})
        self.assertEqual([row.to_dict() for row in plans],
                         samples.rows_of("plan", SCENE, "--budget", "2h", "--cores", "2", "--set", "grains.count=300"))
        self.assertRegex(plans.remarks[0], "the best plan: ")
        self.assertEqual(plans[0].plan, 1)
        self.assertEqual([row.to_dict() for row in floc.plan(SCENE, want={"phi": 0.02, "B": 0.2})],
                         samples.rows_of("plan", SCENE, "--want", "phi=0.02,B=0.2"))
        self.assertEqual([row.to_dict() for row in floc.plan(SCENE, budget=3600, observables="phi")],
                         samples.rows_of("plan", SCENE, "--budget", "1h", "--observables", "phi"))

    def test_write_the_file_of_the_command_and_check_its_runs(self):
        files = [self.directory() / name / "plan.toml" for name in ("python", "command")]
        for file in files:
            file.parent.mkdir(exist_ok=True)
        changes = {"load.0.to": 0.05, "load.0.steps_per_decade": 2, "grains.count": 60}
        floc.plan(SMALL, want={"phi": 0.05}, changes=changes, output=files[0])
        samples.floc_program("plan", SMALL, "--want", "phi=0.05",
                             *(word for key, value in changes.items() for word in ("--set", f"{key}={value}")),
                             "-o", files[1])
        self.assertEqual(files[0].read_text().replace(str(files[0]), str(files[1])), files[1].read_text())
        campaign = self.directory() / "plan"
        samples.floc_program("campaign", "plan", files[0], "-o", campaign)
        with self.assertRaisesRegex(floc.InputError, "0 of .* samples are done: expected at least two"):
            floc.check_plan(campaign)

    def test_replace_a_file_only_if_asked_and_the_scene_never(self):
        scene, output = self.directory() / "scene.toml", self.directory() / "plan.toml"
        scene.write_text(SMALL.read_text())
        output.write_text("mine")
        changes = {"load.0.to": 0.05, "load.0.steps_per_decade": 2, "grains.count": 60}
        with self.assertRaisesRegex(floc.InputError, "plan.toml: this file exists already; give overwrite=True"):
            floc.plan(scene, want={"phi": 0.05}, changes=changes, output=output)
        self.assertEqual(output.read_text(), "mine")
        for overwrite in (False, True):
            with self.assertRaisesRegex(floc.InputError, "scene.toml: this is the scene file"):
                floc.plan(scene, want={"phi": 0.05}, changes=changes, output=scene, overwrite=overwrite)
        self.assertEqual(scene.read_text(), SMALL.read_text())
        floc.plan(scene, want={"phi": 0.05}, changes=changes, output=output, overwrite=True)
        self.assertIn("scene.toml", output.read_text())

    def test_refuse_in_the_words_of_the_command_for_the_arguments(self):
        for arguments, words in (({}, "expected budget"), ({"budget": "2m"}, "budget 2m"),
                                 ({"budget": "1h", "cores": 0}, "cores"), ({"want": {"K0": 0.1}}, "K0 is not a quantity"),
                                 ({"want": {"phi": 0.1}, "observables": ["phi"]}, "cannot be combined"),
                                 ({"budget": float("nan")}, "budget")):
            with self.assertRaisesRegex(floc.InputError, words):
                floc.plan(SCENE, **arguments)
        with self.assertRaisesRegex(floc.InputError, "this directory contains no campaign"):
            floc.check_plan(self.directory())


if __name__ == "__main__":
    unittest.main()

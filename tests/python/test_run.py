"""Tests runs from Python: progress, interruption, resume, errors."""
import os
import signal
import subprocess
import sys
import textwrap
import threading
import unittest

import floc
import samples


def content(directory):
    return {path.name: path.read_bytes() for path in sorted(directory.glob("*.*")) if path.suffix in (".h5", ".csv")}


class Runs(unittest.TestCase):
    def setUp(self):
        self.scene = samples.scene_file("powder")
        self.expected = content(samples.run("powder").directory)

    def directory(self):
        return samples.directory() / self.id().rsplit(".", 1)[1]

    def test_equal_the_command(self):
        samples.floc_program("run", self.scene, "-o", self.directory(), "--no-timing")
        self.assertEqual(content(self.directory()), self.expected)

    def test_tell_their_progress(self):
        told = []
        run = floc.run(self.scene, self.directory(), on_progress=told.append, interval=0.0, timing=False)
        self.assertEqual(content(self.directory()), self.expected)
        reached = [p for p in told if p.equilibrium]
        self.assertEqual([p.step for p in reached], list(range(len(run))))
        self.assertGreater(len(told), len(reached))
        self.assertEqual(reached[-1].solid_fraction, run[-1].solid_fraction)
        self.assertEqual(reached[0].n_steps, len(run))
        self.assertEqual(reached[-1].branch, "unload")
        self.assertEqual(run.path["phi"][-1], run[-1].solid_fraction)

    def test_stopped_by_an_exception_can_be_resumed(self):
        def stop(progress):
            if progress.step == 2:
                raise KeyError("enough")

        with self.assertRaisesRegex(KeyError, "enough"):
            floc.run(self.scene, self.directory(), on_progress=stop, interval=0.0, timing=False)
        self.assertLess(len(floc.Run(self.directory())), len(samples.run("powder")))
        with self.assertRaisesRegex(floc.InputError, "resume"):
            floc.run(self.scene, self.directory(), timing=False)
        floc.run(self.scene, self.directory(), resume=True, timing=False)
        self.assertEqual(content(self.directory()), self.expected)

    def test_interrupted_by_ctrl_c_can_be_resumed(self):
        script = textwrap.dedent("""
            import floc, sys
            try:
                floc.run(sys.argv[1], sys.argv[2], timing=False, interval=0.0,
                         on_progress=lambda p: print(p.step, flush=True))
            except KeyboardInterrupt:
                sys.exit(75)
            """)
        process = subprocess.Popen([sys.executable, "-c", script, self.scene, self.directory()],
                                   stdout=subprocess.PIPE, text=True)
        for line in process.stdout:
            if int(line) >= 1:
                process.send_signal(signal.SIGINT)
                break
        process.stdout.read()
        process.stdout.close()
        self.assertEqual(process.wait(timeout=60), 75)
        self.assertTrue((self.directory() / "checkpoint").exists())
        self.assertLess(len(floc.Run(self.directory())), len(samples.run("powder")))
        floc.run(self.scene, self.directory(), resume=True, timing=False)
        self.assertEqual(content(self.directory()), self.expected)

    def test_in_a_thread_leave_others_alone(self):
        counted = []
        thread = threading.Thread(target=lambda: floc.run(self.scene, self.directory(), timing=False))
        thread.start()
        while thread.is_alive():
            counted.append(None)
            thread.join(0.001)
        self.assertGreater(len(counted), 10)
        self.assertEqual(content(self.directory()), self.expected)

    def test_take_changes_of_the_scene(self):
        run = floc.run(self.scene, self.directory(), changes={"load.0.to": 0.1, "grains.count": 30}, until=1, seed=5)
        self.assertEqual(run[0].n_grains, 30)
        self.assertEqual(len(run), 2)
        self.assertEqual(run[0].provenance["seed"], 5)

    def test_warn_of_threads_that_few_grains_leave_unused(self):
        with self.assertWarnsRegex(floc.FlocWarning, "disks: 1 of 2 threads is used"):
            floc.run(self.scene, self.directory(), threads=2, timing=False)
        self.assertEqual(content(self.directory()), self.expected)

    def test_refuse_bad_scenes_in_words(self):
        with self.assertRaisesRegex(floc.InputError, "nowhere.toml"):
            floc.run("nowhere.toml", self.directory())
        with self.assertRaisesRegex(floc.InputError, "grains.count"):
            floc.run(self.scene, self.directory(), changes={"grains.count": -1})
        with self.assertRaisesRegex(floc.InputError, "resume"):
            floc.run(self.scene, self.directory(), resume=True, overwrite=True)
        self.assertFalse(os.path.exists(self.directory()))

    def test_say_what_does_not_converge(self):
        with self.assertRaisesRegex(floc.NumericalError, "did not converge"):
            floc.run(self.scene, self.directory(), changes={"equilibrium.max_time": 1.0})


if __name__ == "__main__":
    unittest.main()

"""Actions written for other hosts use rclpy's own context, `INVALID` and stubs."""

from __future__ import annotations

import pytest

from tests.executor.application.real_application import HEAD, action, app, run_data, second_run_works, session

pytestmark = pytest.mark.simulation


async def test_rclpy_in_an_action_works_as_in_tutorials():
    source = (
        HEAD.replace("import py_trees\n", "import threading\n\nimport py_trees\nimport rclpy\n")
        + """
    def setup(self, **kwargs):
        from std_msgs.msg import String

        rclpy.init()
        self.node, self.words, self.turns, self.message = kwargs["node"], [], 0, String(data="hello")
        self.other = rclpy.create_node("other")
        self.other.create_subscription(String, "/words", self.words.append, 10)
        self.speaker = self.node.create_publisher(String, "/words", 10)
        self.timer = self.node.create_timer(0.02, self.count)
        # rclpy.spin without an executor would share the global one with spin_once below, in another thread.
        executor = rclpy.executors.SingleThreadedExecutor()
        threading.Thread(target=rclpy.spin, args=(self.other, executor), daemon=True).start()

    def count(self):
        self.turns += 1

    def update(self):
        self.speaker.publish(self.message)
        rclpy.spin_once(self.node, timeout_sec=0.05)
        rclpy.spin_until_future_complete(self.node, rclpy.task.Future(), timeout_sec=0.02)
        if len(self.words) < 3 or self.turns < 20:
            return Status.RUNNING
        print("ok", rclpy.ok(), self.node.executor is not None)
        return Status.SUCCESS
"""
    )
    async with session() as client:
        assert await client.ask("run", run_data(app(source))) == "ack"
        finished = (await client.event("finished"))["data"]
        assert finished["status"] == "SUCCESS", client.named("fault")
        assert "ok True True" in [log["text"] for log in client.named("log")]
        assert client.named("fault") == []
        await second_run_works(client)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        ("rclpy.shutdown()", "rclpy.shutdown() would end ROS for the whole tree"),
        ("self.node.destroy_node()", "node.destroy_node() would take the node from the whole tree"),
    ],
)
async def test_shutting_down_the_ros_of_the_tree_is_a_fault(call, sentence):
    source = action(
        'def setup(self, **kwargs):\n    self.node = kwargs["node"]\n'
        f"def update(self):\n    import rclpy\n    {call}"
    )
    async with session() as client:
        assert await client.ask("run", run_data(app(source))) == "ack"
        fault = (await client.event("fault"))["data"]
        assert sentence in fault["message"]
        assert (fault["node_id"], fault["file"], fault["line"]) == ("n1", "actions/Act.py", 10)
        await client.event("finished")
        await second_run_works(client)


async def test_invalid_counts_as_failure_and_is_reported_once():
    source = action("def update(self):\n    return Status.INVALID")
    async with session() as client:
        assert await client.ask("run", run_data(app(source), on_finish="repeat")) == "ack"
        await client.event("tick", lambda d: d["n"] > 5)
        logs = [log for log in client.named("log") if "INVALID" in log["text"]]
        assert [(log["level"], log["node_id"]) for log in logs] == [("warning", "n1")]
        assert "counts as FAILURE" in logs[0]["text"]
        assert client.named("fault") == []


async def test_a_run_of_stubs_reports_them():
    stub = action(
        '"""bt-studio: to be written."""\ndef update(self):\n    return py_trees.common.Status.FAILURE'
    )
    async with session() as client:
        assert await client.ask("run", run_data(app(stub))) == "ack"
        finished = (await client.event("finished"))["data"]
        told = "Act is an unwritten stub, which always fails: write update() in actions/Act.py."
        assert finished["message"] == f"The tree ended with FAILURE. {told}"
        assert told in [log["text"] for log in client.named("log") if log["level"] == "warning"]

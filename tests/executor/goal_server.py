"""A part of Nav2's `navigate_to_pose`: accepts a goal, works for a moment, and reports the result."""

import json
import sys
import time

import rclpy
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionServer
from rclpy.node import Node

rclpy.init()
node = Node("navigator")


def reach(handle):
    position = handle.request.pose.pose.position
    handle.publish_feedback(NavigateToPose.Feedback(distance_remaining=position.x))
    time.sleep(0.2)  # a goal takes a while: several ticks see it running
    if position.x < 0:
        handle.abort()
    else:
        handle.succeed()
    sys.stdout.write(json.dumps([handle.request.pose.header.frame_id, position.x, position.y]) + "\n")
    sys.stdout.flush()
    return NavigateToPose.Result()


server = ActionServer(node, NavigateToPose, "/navigate_to_pose", reach)
sys.stdout.write("ready\n")
sys.stdout.flush()
rclpy.spin(node)

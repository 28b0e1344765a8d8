"""The protocol of JdeRobot's Robotics Application Manager (RAM), for its existing clients."""

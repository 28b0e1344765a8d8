"""Logs that this version of BT Studio did not write, turned into its recordings.

    convert     finds the format of a file, and converts it
    btlog       BehaviorTree.CPP's FileLogger2
    btsqlite    BehaviorTree.CPP's SqliteLogger
    bags        MCAP and rosbag2: `nav2_msgs/BehaviorTreeLog`, our own types, `/rosout`, scans and pictures
    lines       the lines of JSON of older versions
    apart       the conversion in a child with limits; the only way in for files of others

A file is read once or twice from begin to end and never held whole. What it claims is compared with a bound
before it is used, and counted while it is read. Nothing in it becomes code.
"""

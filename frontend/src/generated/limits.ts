// Generated from translator/limits.json by `python -m translator.reference`.
// Do not edit.

export const LIMITS = {
  /** Nodes of one tree, drafts included. */
  nodes_per_tree: 20000,
  /** Nodes of all trees of a project. */
  nodes_per_project: 100000,
  /** Trees of a project. */
  trees_per_project: 2000,
  /** Levels of a tree that runs (BehaviorTree.CPP takes 256 levels of XML, root and tree included). */
  levels_per_tree: 250,
  /** Bytes of all diagrams of a project together. */
  diagram_bytes_per_project: 33554432,
  /** Bytes of one file, a diagram among them (`BT_STUDIO_MAX_FILE_BYTES`). */
  file_bytes: 33554432,
  /** Bytes of all files of a project (`BT_STUDIO_MAX_PROJECT_BYTES`). */
  project_bytes: 268435456,
  /** Files of a project (`BT_STUDIO_MAX_PROJECT_FILES`). */
  files_per_project: 5000,
  /** Bytes of one file of a folder or zip that is opened from the disk. */
  archived_file_bytes: 67108864,
  /** Bytes of the directory of a zip that is opened. */
  archive_directory_bytes: 4194304,
  /** Entries of a zip that is opened, folders and files of tools included. */
  archive_entries: 20000,
  /** Bytes of the file or zip of which a robot, a world or a map is imported into a project. */
  import_upload_bytes: 268435456,
  /** Bytes of the source of one action. */
  action_bytes: 2097152,
  /** Bytes of one XML file. */
  xml_bytes: 16777216,
  /** Elements of one XML file. */
  xml_elements: 200000,
  /** Levels of one XML file. */
  xml_levels: 256,
  /** Attributes of one XML element. */
  xml_attributes: 500,
  /** Files that an XML file includes, and these in turn. */
  xml_includes: 200,
  /** Bare characters of one XML file that a repair is offered for. */
  xml_repairs: 1000,
  /** Bytes of a file of behaviour tests. */
  yaml_bytes: 2000000,
  /** Values in a file of behaviour tests. */
  yaml_values: 100000,
  /** Levels of nested values in a file of behaviour tests. */
  yaml_levels: 32,
  /** Characters of one tree as text, JSON or XML, where the XML is edited beside the canvas. */
  tree_text_characters: 2000000,
  /** Characters of the ID of a tree, and of a name in `project.json`. */
  name_characters: 200,
  /** Characters of a project's description. */
  description_characters: 10000,
  /** Characters of one script. */
  script_characters: 20000,
} as const;

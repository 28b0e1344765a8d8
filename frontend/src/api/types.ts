/** Types of the REST API; field names are the server's. */
import type { OnError, OnFinish } from '@/generated/messages';

export type Severity = 'error' | 'warning' | 'note';

/** A finding of the checks, at a block, a port, or a line. */
export interface Diagnostic {
  code: string;
  severity: Severity;
  message: string;
  hint?: string | null;
  /** The values that fill the placeholders of message and hint, for a translation. */
  values?: Readonly<Record<string, string>>;
  tree?: string | null;
  node?: string | null;
  port?: string | null;
  file?: string | null;
  line?: number | null;
  column?: number | null;
}

export type PortDirection = 'input' | 'output' | 'inout';

export interface ActionPort {
  name: string;
  direction: PortDirection;
  type: string;
  default?: string | number | boolean | null;
  required?: boolean;
  description?: string;
}

/** The declarations in an action's source. */
export interface ActionModel {
  name: string;
  path?: string;
  doc?: string;
  kind: string;
  /** Absent until the server has read the class. */
  children?: { min: number; max: number | null };
  ports: ActionPort[];
  /** The action declares no ports, so that any port is accepted. */
  open: boolean;
  diagnostics?: Diagnostic[];
}

export interface ProjectSettings {
  format?: string;
  version?: number;
  name: string;
  description?: string;
  main_tree: string;
  tick_hz?: number;
  universe?: string;
  /** If absent, the universe's own robot. */
  robot?: string | undefined;
  on_finish?: OnFinish;
  on_error?: OnError;
  [key: string]: unknown;
}

export type ProjectRole = 'viewer' | 'editor' | 'owner';

export interface ProjectSummary {
  id: string;
  name: string;
  description: string;
  main_tree: string;
  universe: string;
  revision: number;
  created_at: string;
  updated_at: string;
  /** The user's role in the project. */
  role?: ProjectRole;
  owner?: string;
  /** The main tree's diagram, for the picture on the card. */
  root_diagram: unknown;
}

/** One page of a list that may be long. */
export interface ProjectPage {
  items: ProjectSummary[];
  total: number;
  next_offset: number | null;
}

/** The content of a ROS 2 package, before it is downloaded. */
export interface PackagePreview {
  name: string;
  files: { path: string; size: number }[];
  /** The text of `package.xml`. */
  manifest: string;
  diagnostics: Diagnostic[];
}

export interface ProjectFile {
  path: string;
  revision: number;
  size: number;
  sha256: string;
  /** `null` for a binary file. */
  content: string | null;
}

export interface ProjectDetail extends ProjectSummary {
  settings: ProjectSettings;
  files: ProjectFile[];
  actions: ActionModel[];
  diagnostics: Diagnostic[];
}

/** One file of a change set; with `base_revision` 0 the file must not exist yet. */
export interface FileChange {
  path: string;
  base_revision: number;
  content?: string;
  content_base64?: string;
  delete?: true;
  rename_to?: string;
}

export interface SavedFile {
  path: string;
  revision: number;
  size?: number;
  sha256?: string;
  deleted?: boolean;
}

export interface ChangesResult extends CheckResult {
  revision: number;
  files: SavedFile[];
}

/** Two versions of one file: the server's, and one that was sent with an older base. */
export interface Conflict {
  path: string;
  base_revision: number;
  /** `null`: the file was deleted on the server. */
  theirs: { revision: number; content: string | null; updated_at?: string } | null;
  mine: { content: string | null };
}

export interface CheckResult {
  diagnostics: Diagnostic[];
  actions: ActionModel[];
  /** `false`: the check itself failed, so the project's actions are unknown. */
  checked?: boolean;
}

/** The application as the executor runs it. */
export interface AppBundle {
  app_zip_base64: string;
  tick_hz: number;
  on_finish: OnFinish;
  on_error: OnError;
  universe: string | { document: string; assets_zip_base64: string; file: string };
  robot: string | null;
}

export interface SessionInfo {
  id: string;
  state: 'queued' | 'starting' | 'ready' | 'failed' | 'ended';
  position: number | null;
  control_url: string;
  stream_url: string;
  error?: string;
}

export interface TemplateInfo {
  id: string;
  name: string;
  description: string;
  root_diagram?: unknown;
}

/** A behaviour of the built-in library; texts are by language. */
export interface BehaviourInfo {
  id: string;
  version: string;
  group: string;
  universe: string;
  summary: Record<string, string>;
  doc: Record<string, string>;
  diagram: unknown;
  files: Record<string, string>;
}

/** A universe or a robot to choose; `preview` is the URL of its picture. */
export interface UniverseInfo {
  id: string;
  name: string;
  description?: string;
  preview?: string;
}

export interface Me {
  mode: string;
  /** Empty for a guest, who uses a read-only link. */
  user: string;
  name: string;
  email: string;
  role: 'local' | 'administrator' | 'teacher' | 'user' | 'guest';
  version: string;
}

/** The body of every refusal (RFC 9457). */
export interface Problem {
  type?: string;
  title: string;
  status: number;
  code: string;
  detail?: string;
  hint?: string;
  field?: string;
  diagnostics?: Diagnostic[];
  conflicts?: Conflict[];
}

/**
 * What the REST API speaks, by the generated types. Of some answers the page also makes its own, with less in
 * them: these types ask for no more than the page needs.
 */
import type { components } from '@/generated/api';
import type { OnError, OnFinish } from '@/generated/messages';

type Server = components['schemas'];
type Needs<T, Field extends keyof T> = Pick<T, Field> & Partial<Omit<T, Field>>;

export type Severity = Server['DiagnosticSeverityEnum'];

/** A finding of the checks, at a block, a port, or a line. */
export type Diagnostic = Needs<Server['Diagnostic'], 'code' | 'severity' | 'message'>;

export type ActionPort = Needs<Server['Port'], 'name' | 'direction' | 'type'>;

/** What reading an action's source says about it. */
export type ActionModel = Needs<Omit<Server['Action'], 'ports' | 'diagnostics'>, 'name' | 'kind' | 'open'> & {
  ports: ActionPort[];
  diagnostics?: Diagnostic[];
  /** Set by the page: the Python cannot be read now, and this is its last declaration. */
  outdated?: boolean;
};

/** Answers that tell of a project what the translator found in it. */
type Checked<T extends Server['Report']> = Omit<T, keyof Server['Report'] | 'files' | 'settings'> & {
  diagnostics: Diagnostic[];
  actions: ActionModel[];
  /** `false`: the project could not be checked, and its actions are not known. */
  checked?: boolean;
};

/** `project.json`, which is a file of the user: other keys stay as they are. */
export interface ProjectSettings {
  name: string;
  description?: string;
  main_tree: string;
  tick_hz?: number;
  universe?: string;
  /** Absent: the universe's own. */
  robot?: string | undefined;
  on_finish?: OnFinish;
  on_error?: OnError;
  [key: string]: unknown;
}

export type ProjectRole = Server['ProjectRole'];
type Kept = 'role' | 'owner' | 'size' | 'archived_at' | 'deleted_at';
export type ProjectSummary = Needs<Server['ProjectSummary'], Exclude<keyof Server['ProjectSummary'], Kept>>;
export type ProjectFile = Needs<Server['File'], keyof Server['FileInfo'] | 'content'>;
export type ImportedProject = ProjectDetail & Pick<Server['ImportedProject'], 'proposal'>;
export type ProjectDetail = ProjectSummary &
  Checked<Server['Report']> & { settings: Server['ProjectDetail']['settings']; files: ProjectFile[] };

/** One file of a change set; `base_revision` 0 says that it must not exist yet. */
export type FileChange = Server['FileChangeRequest'];
export type ChangesResult = Checked<Server['ChangesDone']> & {
  files: Needs<Server['FileInfo'], 'path' | 'revision'>[];
};
/** Two versions of one file: what the server holds, and what was sent on an older base. */
export type Conflict = Omit<Server['Conflict'], 'theirs'> & {
  /** `null`: the file was deleted there. */
  theirs: Needs<Server['Theirs'], 'revision' | 'content'> | null;
};
export type CheckResult = Checked<Server['Report']>;

/** What the executor runs. */
export type AppBundle = Server['App'];
export type SessionInfo = Needs<
  Server['Session'],
  'id' | 'state' | 'position' | 'control_url' | 'stream_url'
>;

/** What a ROS 2 package will hold, before it is downloaded. */
export type PackagePreview = Omit<Server['PackagePreview'], 'diagnostics'> & { diagnostics: Diagnostic[] };

export type TemplateInfo = Needs<Server['Template'], 'id' | 'name' | 'description'>;
/** A behaviour of the built-in library; texts are by language. */
export type BehaviourInfo = Server['Behaviour'];
/** A universe or a robot to choose; `preview` is the address of its picture. */
export type UniverseInfo = Needs<Server['Entry'], 'id' | 'name'>;
export type Me = Server['Me'];

/** RFC 9457 body of every refusal; the page makes some itself, when no server answers. */
export type Problem = Needs<Server['Problem'], 'title' | 'status' | 'code'> & {
  diagnostics?: Diagnostic[];
  conflicts?: Conflict[];
};

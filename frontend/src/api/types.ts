/**
 * The types of the REST API's data. The page builds some of them itself, with fewer fields: these types
 * require only the fields that the page needs.
 */
import type { components } from '@/generated/api';
import type { OnError, OnFinish, RunTime } from '@/generated/messages';

type Server = components['schemas'];
type Needs<T, Field extends keyof T> = Pick<T, Field> & Partial<Omit<T, Field>>;

export type Severity = Server['DiagnosticSeverityEnum'];

/** A finding of the checks, at a block, a port, or a line. */
export type Diagnostic = Needs<Server['Diagnostic'], 'code' | 'severity' | 'message'>;

export type ActionPort = Needs<Server['Port'], 'name' | 'direction' | 'type'>;

/** The description of an action, read from its source. */
export type ActionModel = Needs<Omit<Server['Action'], 'ports' | 'diagnostics'>, 'name' | 'kind' | 'open'> & {
  ports: ActionPort[];
  diagnostics?: Diagnostic[];
  /** Set by the page: the Python has a syntax error now, so this is its last valid declaration. */
  outdated?: boolean;
};

/** An answer about a project, with the findings of the translator. */
type Checked<T extends Server['Report']> = Omit<T, keyof Server['Report'] | 'files' | 'settings'> & {
  diagnostics: Diagnostic[];
  actions: ActionModel[];
  /** That of the project, stated or needed; absent if the project could not be checked. */
  ros_distro?: RosDistro | null;
  /** `false`: the project could not be checked, so its actions are unknown. */
  checked?: boolean;
};

export type RosDistro = Server['RosDistroEnum'];

/** What a change of the ROS distribution would do. */
export type DistributionChange = Server['DistributionChange'];

/** `project.json`. It is a file of the user: other keys are kept. */
export interface ProjectSettings {
  name: string;
  description?: string;
  main_tree: string;
  tick_hz?: number;
  universe?: string;
  /** Absent: the universe's own robot. */
  robot?: string | undefined;
  on_finish?: OnFinish;
  on_error?: OnError;
  /** Absent: `live`. */
  time?: RunTime;
  /** Absent: the one that has the project's nodes of Nav2. */
  ros_distro?: RosDistro;
  [key: string]: unknown;
}

export type ProjectRole = Server['ProjectRole'];
type Kept = 'role' | 'owner' | 'size' | 'archived_at' | 'deleted_at';
export type ProjectSummary = Needs<Server['ProjectSummary'], Exclude<keyof Server['ProjectSummary'], Kept>>;
export type ProjectFile = Needs<Server['File'], keyof Server['FileInfo'] | 'content'>;
export type ImportedProject = ProjectDetail & Pick<Server['ImportedProject'], 'proposal' | 'one_block'>;
export type ProjectDetail = ProjectSummary &
  Checked<Server['Report']> & { settings: Server['ProjectDetail']['settings']; files: ProjectFile[] };

/** The trees that one project offers to others. */
export type OfferInfo = Server['Offer'];

/** One file of a change set; `base_revision` 0 requires that the file does not exist yet. */
export type FileChange = Server['FileChangeRequest'];
export type ChangesResult = Checked<Server['ChangesDone']> & {
  files: Needs<Server['FileInfo'], 'path' | 'revision'>[];
};
/** Two versions of one file: the server's, and the one that was sent on an older base. */
export type Conflict = Omit<Server['Conflict'], 'theirs'> & {
  /** `null`: the file was deleted on the server. */
  theirs: Needs<Server['Theirs'], 'revision' | 'content'> | null;
};
export type CheckResult = Checked<Server['Report']>;

/** The results of a project's behaviour tests. */
export type TestReport = Omit<Server['TestReport'], 'problems'> & { problems: Diagnostic[] };
export type TestOutcome = Server['TestOutcome'];
/** The turn of tests with Python that wait for a place. */
export type TestTurn = Needs<Server['TestTurn'], keyof Server['TestTurn']>;
export type TestFailure = Server['TestFailure'];

/** The application that the executor runs. */
export type AppBundle = Server['App'];
export type SessionInfo = Needs<
  Server['Session'],
  'id' | 'state' | 'position' | 'control_url' | 'stream_url' | 'target'
>;
/** A session of the user that waits, starts or runs. */
export type OwnSession = SessionInfo & Needs<Server['OwnSession'], 'project_id' | 'project_name'>;

/** The contents of a ROS 2 package, before it is downloaded. */
export type PackagePreview = Omit<Server['PackagePreview'], 'diagnostics'> & { diagnostics: Diagnostic[] };

export type TemplateInfo = Needs<Server['Template'], 'id' | 'name' | 'description'>;
/** A behaviour of the built-in library, with its texts by language. */
export type BehaviourInfo = Server['Behaviour'];
/** A node of Nav2 that a project can take, with its source. */
export type OfferedAction = ActionModel & Pick<Server['OfferedAction'], 'text'>;
/** An interface of ROS that is installed on the server, and a field of one as a port. */
export type InterfaceName = Server['InterfaceName'];
export type FieldInfo = Server['Field'];
/** A universe or a robot that can be chosen; `preview` is the address of its picture. */
export type UniverseInfo = Needs<Server['Entry'], 'id' | 'name'>;
export type Me = Server['Me'];

/** The RFC 9457 body of a refusal. The page makes one itself when no server answers. */
export type Problem = Needs<Server['Problem'], 'title' | 'status' | 'code'> & {
  diagnostics?: Diagnostic[];
  conflicts?: Conflict[];
};

import type { components, operations } from '@/generated/api';
import { dataOf, done, rest, urlOf } from './http';
import type {
  ActionModel,
  DistributionChange,
  OfferedAction,
  RosDistro,
  ChangesResult,
  CheckResult,
  FieldInfo,
  FileChange,
  PackagePreview,
  ImportedProject,
  InterfaceName,
  OfferInfo,
  ProjectDetail,
  ProjectSettings,
  ProjectSummary,
  OwnSession,
  SessionInfo,
  TestReport,
  TestTurn,
  TemplateInfo,
  UniverseInfo,
} from './types';

type ProjectQuery = Required<NonNullable<operations['list_projects']['parameters']['query']>>;
export type ProjectSort = ProjectQuery['sort'];
export type ProjectShelf = ProjectQuery['shelf'];

/** The order of children on JdeRobot's canvas. */
export type ChildOrder = 'bottom-to-top' | 'top-to-bottom';

/** A file that is imported as a project, with what the user chose. */
export interface ImportChoices {
  readonly file: File;
  readonly repair: boolean;
  readonly main?: string;
  /** The order of children; with `ask`, one that leaves a branch out is refused. */
  readonly order?: 'ask' | ChildOrder;
}

/** One page of the list of projects, which may be long. */
type ProjectPage = Omit<components['schemas']['ProjectList'], 'items'> & { items: ProjectSummary[] };

/** The number of projects on one page: it fills a large screen twice. */
const PAGE = 48;

/** The number of projects on one page of offers. */
const OFFERS = 20;

const project = (id: string) => `/projects/${encodeURIComponent(id)}`;
const inProject = (project_id: string) => ({ path: { project_id } });
const abortedBy = (signal: AbortSignal | undefined) => ({ signal: signal ?? null });

/** The calls of the REST API, one function each. They throw a refusal as `ApiError`. */
export const api = {
  me: () => dataOf(rest.GET('/api/v1/me')),

  listProjects: (asked: Omit<ProjectQuery, 'limit'>, signal?: AbortSignal): Promise<ProjectPage> => {
    const query = { ...asked, limit: PAGE };
    return dataOf(rest.GET('/api/v1/projects', { params: { query }, ...abortedBy(signal) }));
  },
  /** All trees that projects offer. The server answers page by page. */
  offers: async (signal?: AbortSignal): Promise<OfferInfo[]> => {
    const items: OfferInfo[] = [];
    for (let offset: number | null = 0; offset !== null;) {
      const query = { offset, limit: OFFERS };
      const call = rest.GET('/api/v1/projects/offers', { params: { query }, ...abortedBy(signal) });
      const page: components['schemas']['OfferList'] = await dataOf(call);
      items.push(...page.items);
      offset = page.next_offset;
    }
    return items;
  },
  createProject: (body: { name?: string; template?: string }): Promise<ProjectDetail> =>
    dataOf(rest.POST('/api/v1/projects', { body })),
  getProject: (id: string, signal?: AbortSignal): Promise<ProjectDetail> =>
    dataOf(rest.GET('/api/v1/projects/{project_id}', { params: inProject(id), ...abortedBy(signal) })),
  /** The text of a file that is left out of its project; null if it is not text. */
  fileText: async (project_id: string, path: string, signal?: AbortSignal): Promise<string | null> => {
    const params = { path: { project_id, path } };
    const text = await dataOf(
      rest.GET('/api/v1/projects/{project_id}/files/{path}', {
        params,
        parseAs: 'text',
        ...abortedBy(signal),
      }),
    );
    return text.includes('\u0000') ? null : text;
  },
  patchProject: (
    id: string,
    body: { name?: string; description?: string; settings?: Partial<ProjectSettings>; base_revision: number },
  ): Promise<ProjectDetail> =>
    dataOf(rest.PATCH('/api/v1/projects/{project_id}', { params: inProject(id), body })),
  deleteProject: (id: string) =>
    done(rest.DELETE('/api/v1/projects/{project_id}', { params: inProject(id) })),
  restoreProject: (id: string) =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/restore', { params: inProject(id) })),
  archiveProject: (id: string) =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/archive', { params: inProject(id) })),
  unarchiveProject: (id: string) =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/unarchive', { params: inProject(id) })),
  duplicateProject: (id: string): Promise<ProjectDetail> =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/duplicate', { params: inProject(id), body: {} })),
  // The file is the body itself: it may then be larger than any other request.
  importProject: ({ file, repair, main, order }: ImportChoices): Promise<ImportedProject> => {
    const query = {
      filename: file.name,
      ...(order ? { order } : {}),
      ...(repair ? { repair } : {}),
      ...(main ? { main } : {}),
    };
    return dataOf(
      rest.POST('/api/v1/projects/import', {
        params: { query },
        body: file,
        bodySerializer: (body) => body,
        headers: { 'Content-Type': 'application/octet-stream' },
      }),
    );
  },
  exportUrl: (id: string) => urlOf(`${project(id)}/export`),
  xmlUrl: (id: string, isSelfContained: boolean) =>
    urlOf(`${project(id)}/xml?self_contained=${String(isSelfContained)}`),
  cppUrl: (id: string) => urlOf(`${project(id)}/cpp`),
  modelsUrl: (id: string) => urlOf(`${project(id)}/models`),
  schemaUrl: (id: string) => urlOf(`${project(id)}/xsd`),
  packageUrl: (id: string, name: string) =>
    urlOf(`${project(id)}/package?${new URLSearchParams({ name }).toString()}`),
  previewPackage: (id: string, name: string, signal?: AbortSignal): Promise<PackagePreview> => {
    const params = { ...inProject(id), query: { name } };
    return dataOf(
      rest.GET('/api/v1/projects/{project_id}/package/preview', { params, ...abortedBy(signal) }),
    );
  },

  saveChanges: (
    id: string,
    body: { message: string; files: FileChange[] },
    keepalive = false,
  ): Promise<ChangesResult> =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/changes', { params: inProject(id), body, keepalive })),
  check: (
    id: string,
    files: { path: string; content: string }[] = [],
    signal?: AbortSignal,
  ): Promise<CheckResult> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/check', {
        params: inProject(id),
        body: { files },
        ...abortedBy(signal),
      }),
    ),
  /** The files of the project for another ROS distribution; nothing is written. */
  changeDistribution: (id: string, ros_distro: RosDistro): Promise<DistributionChange> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/distribution', {
        params: inProject(id),
        body: { ros_distro, files: [] },
      }),
    ),
  /** Runs the behaviour tests of the project as it would be with these files. */
  test: (
    id: string,
    files: readonly { readonly path: string; readonly content: string }[] = [],
  ): Promise<TestReport> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/test', { params: inProject(id), body: { files: [...files] } }),
    ),
  /** Runs all behaviour tests, also those with leaves that run Python of the project. */
  testWithPython: (id: string): Promise<TestReport> =>
    dataOf(
      rest.POST('/api/v1/projects/{project_id}/test-with-python', {
        params: inProject(id),
        body: { files: [] },
      }),
    ),
  /** What is before the user's tests with Python, while they wait for a place. */
  testTurn: (id: string, signal?: AbortSignal): Promise<TestTurn> =>
    dataOf(
      rest.GET('/api/v1/projects/{project_id}/test-with-python', {
        params: inProject(id),
        ...abortedBy(signal),
      }),
    ),
  /** Ends the user's tests with Python of a project, which run or wait. */
  endTests: (id: string): Promise<void> =>
    done(rest.DELETE('/api/v1/projects/{project_id}/test-with-python', { params: inProject(id) })),
  xml: (id: string) =>
    dataOf(rest.GET('/api/v1/projects/{project_id}/xml', { params: inProject(id), parseAs: 'text' })),
  inspectAction: (source: string, filename: string): Promise<ActionModel> =>
    dataOf(rest.POST('/api/v1/actions/inspect', { body: { source, filename } })),

  formatPython: (source: string, filename: string) =>
    dataOf(rest.POST('/api/v1/python/format', { body: { source, filename } })),
  lintPython: async (source: string, filename: string, signal?: AbortSignal) => {
    const body = { source, filename };
    return (await dataOf(rest.POST('/api/v1/python/lint', { body, ...abortedBy(signal) }))).findings;
  },

  /** Returns the application as it runs, optionally in a universe other than the project's. */
  app: (id: string, universe?: string | null) => {
    const params = { ...inProject(id), ...(universe ? { query: { universe } } : {}) };
    return dataOf(rest.GET('/api/v1/projects/{project_id}/app', { params }));
  },
  startSession: (id: string): Promise<SessionInfo> =>
    dataOf(rest.POST('/api/v1/projects/{project_id}/session', { params: inProject(id) })),
  /** Starts a session that follows the program at an address, or returns the one that does. */
  attach: (address: string): Promise<SessionInfo> =>
    dataOf(rest.POST('/api/v1/sessions/attached', { body: { address } })),
  /** Starts the processes of an attached session in advance. */
  prepareAttach: () => done(rest.POST('/api/v1/sessions/attached/prepare')),
  getSession: (session_id: string): Promise<SessionInfo> =>
    dataOf(rest.GET('/api/v1/sessions/{session_id}', { params: { path: { session_id } } })),
  /** The sessions of the user that wait, start or run, of all projects. */
  ownSessions: async (): Promise<OwnSession[]> => (await dataOf(rest.GET('/api/v1/sessions'))).items,
  endSession: (session_id: string) =>
    done(rest.DELETE('/api/v1/sessions/{session_id}', { params: { path: { session_id } } })),

  templates: async (): Promise<TemplateInfo[]> => (await dataOf(rest.GET('/api/v1/catalog/templates'))).items,
  /** The nodes of Nav2 in a ROS distribution. */
  offeredActions: async (ros_distro: RosDistro): Promise<OfferedAction[]> =>
    (await dataOf(rest.GET('/api/v1/catalog/actions', { params: { query: { ros_distro } } }))).items,
  interfaces: async (): Promise<InterfaceName[]> =>
    (await dataOf(rest.GET('/api/v1/catalog/interfaces'))).items,
  interfaceFields: async (name: string): Promise<FieldInfo[]> =>
    (
      await dataOf(
        rest.GET('/api/v1/catalog/interfaces/{interface}', { params: { path: { interface: name } } }),
      )
    ).ports,
  behaviours: async () => (await dataOf(rest.GET('/api/v1/catalog/behaviours'))).items,
  universes: async (): Promise<UniverseInfo[]> => (await dataOf(rest.GET('/api/v1/catalog/universes'))).items,
  universeText: (universe_id: string) =>
    dataOf(
      rest.GET('/api/v1/catalog/universes/{universe_id}/text', {
        params: { path: { universe_id } },
        parseAs: 'text',
      }),
    ),
  robotConfig: (robot_id: string) =>
    dataOf(
      rest.GET('/api/v1/catalog/robots/{robot_id}/config', {
        params: { path: { robot_id } },
        parseAs: 'text',
      }),
    ),
  robotUrdf: (robot_id: string) =>
    dataOf(
      rest.GET('/api/v1/catalog/robots/{robot_id}/urdf', { params: { path: { robot_id } }, parseAs: 'text' }),
    ),
  robots: async (): Promise<UniverseInfo[]> => (await dataOf(rest.GET('/api/v1/catalog/robots'))).items,
};

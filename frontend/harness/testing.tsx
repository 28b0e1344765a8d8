import { MantineProvider } from '@mantine/core';
import { Notifications, notifications } from '@mantine/notifications';
import { QueryClientProvider } from '@tanstack/react-query';
import { act, cleanup, render } from '@testing-library/react';
import userEvent, { PointerEventsCheckLevel } from '@testing-library/user-event';
import type { ReactElement, ReactNode } from 'react';
import { afterAll, onTestFinished, vi } from 'vitest';
import { queries } from '@/api/queries';
import type { ActionModel, Diagnostic } from '@/api/types';
import type { Commands, Events, Introspection, ServerMessage } from '@/generated/messages';
import '@/i18n';
import type { DiagramNode } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { useLiveStore } from '@/store/project/live';
import { setNavigator } from '@/store/project/navigation';
import { useLivePorts } from '@/store/run/livePorts';
import { useRunStore } from '@/store/run/store';
import { ensureConnected, leave } from '@/store/session/connection';
import { initialSession } from '@/store/session/reduce';
import { flush, useSessionStore } from '@/store/session/store';
import { useTopicsStore } from '@/store/session/topics';
import { projectDetail, projectFile } from '@/store/testing';
import { theme } from '@/ui/theme';
import { sentBodies } from './sentBodies';

// A refused request is an answer, and not to be tried again after a second.
queries.setDefaultOptions({ queries: { retry: false } });

// Notifications are kept in their library, which all files share.
afterAll(() => {
  notifications.clean();
  notifications.cleanQueue();
});

/** Types and clicks without waiting, and without computing styles before each click. */
export const user = userEvent.setup({ delay: null, pointerEventsCheck: PointerEventsCheckLevel.Never });

function Page({ children }: { readonly children: ReactNode }) {
  return (
    <QueryClientProvider client={queries}>
      <MantineProvider theme={theme} env="test" withCssVariables={false} withGlobalClasses={false}>
        <Notifications />
        {children}
      </MantineProvider>
    </QueryClientProvider>
  );
}

/** Renders a component as the page does, with its theme, notifications and queries. */
export function show(element: ReactElement) {
  return render(element, { wrapper: Page });
}

export interface TestProject {
  /** Nodes by tree; the first node of each is its root. */
  readonly trees?: Readonly<Record<string, Readonly<Record<string, DiagramNode>>>>;
  readonly actions?: readonly ActionModel[];
  readonly texts?: Readonly<Record<string, string>>;
  readonly diagnostics?: readonly Diagnostic[];
  /** Selected blocks of the first tree. */
  readonly selected?: readonly string[];
}

const treeText = (id: string, nodes: Readonly<Record<string, DiagramNode>>): string =>
  JSON.stringify({
    format: 'bt-studio/diagram',
    version: 1,
    id,
    root: Object.keys(nodes)[0] ?? null,
    nodes,
    drafts: [],
  });

/** Opens a project in the real store, as the server would send it. */
export function openProject({ trees = {}, actions = [], texts = {}, diagnostics, selected }: TestProject) {
  const mainTree = Object.keys(trees)[0] ?? 'MainTree';
  const files = [
    ...Object.entries(trees).map(([id, nodes]) => projectFile(`trees/${id}.json`, 1, treeText(id, nodes))),
    ...Object.entries(texts).map(([path, text]) => projectFile(path, 1, text)),
  ];
  useProjectStore.getState().load({
    ...projectDetail(1, files, mainTree),
    actions: [...actions],
    diagnostics: [...(diagnostics ?? [])],
  });
  if (selected) useProjectStore.getState().select(mainTree, selected);
  onTestFinished(() => {
    cleanup();
    useProjectStore.getState().close();
  });
}

/** A node of an open tree. */
export const nodeOf = (tree: string, id: string): DiagramNode | undefined =>
  useProjectStore.getState().diagrams[tree]?.nodes[id];

export const port = (name: string, type: string, more: Partial<ActionModel['ports'][number]> = {}) => ({
  name,
  type,
  direction: 'input' as const,
  default: null,
  required: false,
  description: '',
  ...more,
});

export const action = (name: string, more: Partial<ActionModel> = {}): ActionModel => ({
  name,
  kind: 'Action',
  path: `actions/${name}.py`,
  open: false,
  doc: '',
  line: 1,
  ports: [],
  imports: [],
  diagnostics: [],
  ...more,
});

/** Records what is opened: documents belong to the frame, which these tests leave out. */
export function watchNavigation() {
  const navigator = {
    openTree: vi.fn(),
    showTree: vi.fn(() => true),
    openFile: vi.fn(),
    showFile: vi.fn(),
    openTopics: vi.fn(),
    focusField: vi.fn(),
    aimAt: vi.fn(),
    renamed: vi.fn(),
  };
  setNavigator(navigator);
  onTestFinished(() => {
    setNavigator(null);
  });
  return navigator;
}

export const INTRODUCTION: Introspection = {
  protocol: 'bt-studio.v1',
  client_id: 'page',
  role: 'driver',
  state: 'application_running',
  version: '1',
  ros_distro: 'jazzy',
  ros_domain_id: 1,
  renderer: '',
  tf: true,
  ros_environment: {},
};

interface SentCommand {
  readonly id: string;
  readonly command: string;
  readonly data: unknown;
}

/** The other end of the control socket: records commands but pings, confirms or refuses them, and sends events. */
export class FakeExecutor {
  readonly sent: SentCommand[] = [];
  private refusals: Record<string, { code: string; message: string; hint: string }> = {};
  private readonly waiting: Record<string, string[]> = {};
  private socket: FakeSocket | null = null;
  private seq = 0;

  attach(socket: FakeSocket): void {
    this.socket = socket;
  }

  /** From now on the command is refused with this message. */
  refuse(command: keyof Commands, message: string, hint = '', code = 'refused'): void {
    this.refusals[command] = { code, message, hint };
  }

  /** From now on the command takes until the returned function is called; it confirms the oldest one. */
  takeLong(command: keyof Commands): () => void {
    const ids: string[] = [];
    this.waiting[command] = ids;
    return () => {
      const id = ids.shift();
      if (id !== undefined) act(() => this.post({ id, command: 'ack', data: {} }));
    };
  }

  /** What was sent with a command, each time. */
  sentAs(command: keyof Commands): unknown[] {
    return this.sent.filter((each) => each.command === command).map(({ data }) => data);
  }

  receive(text: string): void {
    const message = JSON.parse(text) as SentCommand;
    // Pings are sent as time passes, whatever a test does.
    if (message.command !== 'ping') this.sent.push(message);
    const waiting = this.waiting[message.command];
    if (waiting) {
      waiting.push(message.id);
      return;
    }
    const refusal = this.refusals[message.command];
    this.post({ id: message.id, command: refusal ? 'error' : 'ack', data: refusal ?? {} });
  }

  /** Sends an event; the page has changed when this returns. */
  emit<K extends keyof Events>(command: K, data: Events[K], t = 1): void {
    act(() => {
      this.post({ id: 'e', command, data, t });
      flush();
    });
  }

  introduce(more: Partial<Introspection>): void {
    this.emit('introspection', { ...INTRODUCTION, ...more });
  }

  private post(message: Pick<ServerMessage, 'id' | 'command' | 'data'> & { t?: number }): void {
    this.seq += 1;
    this.socket?.onmessage?.({ data: JSON.stringify({ seq: this.seq, t: 1, ...message }) });
  }
}

class FakeSocket {
  static readonly OPEN = 1;
  readonly readyState = FakeSocket.OPEN;
  readonly bufferedAmount = 0;
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: string }) => void) | null = null;
  onclose: ((event: { code: number; reason: string }) => void) | null = null;

  constructor(private readonly executor: FakeExecutor) {
    executor.attach(this);
  }

  send(text: string): void {
    this.executor.receive(text);
  }

  close(): void {
    // The page closes it by itself: nothing is lost.
  }
}

class FakeWorker {
  onmessage: unknown = null;
  postMessage(): void {
    // Pictures and poses have tests of their own.
  }
}

const SESSION = {
  id: 's1',
  state: 'ready',
  control_url: '/ws/sessions/s1/control',
  stream_url: '/ws/sessions/s1/streams',
  error: null,
};

/** Connects the page to an executor in the given state, over a fake socket. */
export async function openSession(introduction: Partial<Introspection> = {}): Promise<FakeExecutor> {
  const executor = new FakeExecutor();
  const Socket = Object.assign(
    function open() {
      return new FakeSocket(executor);
    },
    { OPEN: FakeSocket.OPEN },
  );
  vi.stubGlobal('WebSocket', Socket);
  vi.stubGlobal('Worker', FakeWorker);
  const server = fakeServer({ 'POST /projects/p1/session': SESSION });
  const connected = ensureConnected('p1');
  await vi.waitUntil(() => {
    if (server.requests.length === 0) return false;
    executor.introduce(introduction);
    return useSessionStore.getState().connection === 'open';
  });
  await connected;
  onTestFinished(() => {
    cleanup();
    leave();
    resetStores();
    vi.unstubAllGlobals();
  });
  return executor;
}

/** Empties the stores of a run. */
function resetStores(): void {
  useSessionStore.setState(initialSession, true);
  useLiveStore.getState().clear();
  useRunStore.setState(useRunStore.getInitialState(), true);
  useLivePorts.setState(useLivePorts.getInitialState(), true);
  useTopicsStore.setState(useTopicsStore.getInitialState(), true);
  localStorage.clear();
}

interface FakeRequest {
  readonly method: string;
  readonly path: string;
  readonly body: unknown;
}

/**
 * Replaces `fetch`: answers by method and path, 404 for any other, and records the requests. A list is sent
 * under `items`, as the server sends all its lists.
 */
export function fakeServer(answers: Readonly<Record<string, unknown>>) {
  const requests: FakeRequest[] = [];
  vi.stubGlobal('fetch', async (input: string | Request, init?: RequestInit) => {
    const request =
      typeof input === 'string' ? new Request(new URL(input, window.location.origin), init) : input;
    const { method } = request;
    const { pathname, search } = new URL(request.url);
    const path = pathname.replace(/^\/api\/v1/, '') + search;
    const body = sentBodies.get(request);
    requests.push({ method, path, body: typeof body === 'string' ? JSON.parse(body) : body });
    const answer = await answers[`${method} ${path}`];
    if (answer instanceof Response) return answer.clone();
    return answer === undefined
      ? Response.json({ title: 'Not found', code: 'not_found' }, { status: 404 })
      : Response.json(Array.isArray(answer) ? { items: answer } : answer);
  });
  onTestFinished(() => {
    cleanup();
    queries.clear();
    notifications.clean();
    vi.unstubAllGlobals();
  });
  return { requests };
}

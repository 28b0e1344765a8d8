import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import { socketUrl } from '@/api/http';
import type { SessionInfo } from '@/api/types';
import { t } from '@/i18n';
import type { Commands, Introspection, ServerMessage, State } from '@/generated/messages';
import { CommandError, ControlSocket } from './control';
import { forgetRun, rememberRun } from './trace/overReload';
import { Heartbeat, HEARTBEAT_MS } from './heartbeat';
import { note, receive, resetSession, useSessionStore } from './store';
import { streams } from './streams';
import { resetTopics, useTopicsStore } from './topics';

const RETRY_MS = [300, 600, 1200, 2500, 5000];
/** How often a topic that is listened to is heard. */
export const ECHO_HZ = 10;
/** With this code the server closes the socket of a session that it ended because nothing answered. */
const EXECUTOR_SILENT = 4504;
const STORAGE_PREFIX = 'bts.session.';

/** States in which the manager gives streams. */
const STREAMING: readonly State[] = ['visualization_ready', 'application_running', 'paused'];

let socket: ControlSocket | null = null;
let session: SessionInfo | null = null;
/** Who this page is in its session: by it the manager knows a page that comes back. */
let clientId: string | null = null;
let attempt = 0;
/** The end of the session before: until then the server would give it out once more. */
let ending: Promise<unknown> = Promise.resolve();
let giveUp: ((error: Error) => void) | null = null;
let retryTimer: ReturnType<typeof setTimeout> | undefined;

const set = useSessionStore.setState;

export function send<K extends keyof Commands>(command: K, data: Commands[K]): Promise<void> {
  return socket ? socket.send(command, data) : Promise.reject(new Error('There is no session.'));
}

/** Starts the project's session, or joins the one that runs, and waits until it answers. */
export async function ensureConnected(projectId: string): Promise<void> {
  if (socket?.isOpen && useSessionStore.getState().projectId === projectId) return;
  set({ connection: 'starting', projectId });
  const givenUp = new Promise<never>((_, reject) => {
    giveUp = reject;
  });
  const isWanted = () => giveUp !== null;
  try {
    const begun = ending.then(() => (isWanted() ? api.startSession(projectId) : givenUp));
    session = await Promise.race([begun, givenUp]);
    await Promise.race([openSocket(session), givenUp]);
  } catch (error) {
    resetSession();
    throw error;
  } finally {
    giveUp = null;
  }
  localStorage.setItem(STORAGE_PREFIX + projectId, session.id);
}

/** Ends the wait for a session that starts; one that ran already goes on without this page. */
export async function abandonStart(): Promise<void> {
  const starting = session;
  disconnect();
  if (starting && starting.state !== 'ready') await endOnServer(starting.id);
}

/** After a reload: joins the session that this project had, if it still runs. */
export async function reattach(projectId: string): Promise<void> {
  const id = localStorage.getItem(STORAGE_PREFIX + projectId);
  set({ projectId });
  if (!id) return;
  try {
    const found = await api.getSession(id);
    if (found.state !== 'ready') return;
    session = found;
    await openSocket(found);
  } catch {
    localStorage.removeItem(STORAGE_PREFIX + projectId);
  }
}

/** Ends all processes of the session. */
export async function endSession(): Promise<void> {
  const left = session;
  const { projectId } = useSessionStore.getState();
  disconnect();
  if (projectId) localStorage.removeItem(STORAGE_PREFIX + projectId);
  if (left) await endOnServer(left.id);
}

async function endOnServer(id: string): Promise<void> {
  const ended = api.endSession(id);
  ending = ended.catch(() => undefined);
  await ended;
}

/** Leaves the session without ending it, since the project is left. */
export function leave(): void {
  disconnect();
  resetSession({ projectId: null, logs: [] });
}

function disconnect(): void {
  clearTimeout(retryTimer);
  stopHeartbeat();
  giveUp?.(new CommandError('cancelled', 'The start was cancelled.', ''));
  socket?.close();
  socket = null;
  session = null;
  clientId = null;
  isStreaming = false;
  isWorldUp = false;
  streams.close();
  forgetRun();
  resetTopics();
  resetSession();
}

/** The address of a session's socket for this page. */
function addressFor(path: string): string {
  const query = clientId === null ? '' : `?client=${encodeURIComponent(clientId)}`;
  return socketUrl(path) + query;
}

/** Resolves when the manager has introduced itself; rejects if the socket closes before. */
function openSocket(info: SessionInfo): Promise<void> {
  socket?.close();
  return new Promise((resolve, reject) => {
    let isIntroduced = false;
    const opened = new ControlSocket(addressFor(info.control_url), {
      onOpen: () => undefined,
      onHeard: () => heartbeat?.heard(performance.now()),
      onMessage: (message) => {
        receive(message);
        // A later one says that the client's role has changed, or what the world can do.
        if (message.command === 'introspection' && !isIntroduced) {
          isIntroduced = true;
          onIntroduced(info, message.data as Introspection);
          resolve();
        }
        followState(message);
      },
      onLost: (code, reason) => {
        if (!isIntroduced) return reject(new Error(reason || 'The session did not answer.'));
        lostBecause = code === EXECUTOR_SILENT ? t('run:banner.givenUp') : '';
        onLost(lostBecause || reason);
      },
    });
    socket = opened;
    opened.open();
  });
}

function onIntroduced(info: SessionInfo, introspection: Introspection): void {
  attempt = 0;
  clientId = introspection.client_id;
  rememberRun(info.id);
  set({ connection: 'open', connectionMessage: '', sessionId: info.id });
  streams.open(addressFor(info.stream_url));
  followStreams(introspection.state);
  followTopics(introspection.state);
  startHeartbeat();
}

let heartbeat: Heartbeat | null = null;
let heartbeatTimer: ReturnType<typeof setInterval> | undefined;
let isPinging = false;

/** From now on the session is asked every second whether it answers. */
function startHeartbeat(): void {
  stopHeartbeat();
  heartbeat = new Heartbeat(performance.now());
  heartbeatTimer = setInterval(beat, HEARTBEAT_MS);
}

function stopHeartbeat(): void {
  clearInterval(heartbeatTimer);
  heartbeat = null;
  isPinging = false;
}

function beat(): void {
  if (!socket || !heartbeat) return;
  const now = performance.now();
  // As long as this page's own words are on their way out (a large program), it waits for no answer yet.
  if (!isPinging || socket.isSending) heartbeat.heard(now);
  showSilence(heartbeat.beat(now));
  if (isPinging) return;
  isPinging = true;
  const asked = heartbeat;
  const answered = () => {
    if (asked === heartbeat) isPinging = false;
  };
  // A refusal is an answer, too.
  socket.send('ping', {}).then(answered, answered);
}

function showSilence(silentS: number): void {
  const before = useSessionStore.getState().silentS;
  if (silentS === before) return;
  set({ silentS });
  if (before === 0) note(t('run:silence.began', { seconds: silentS }));
  else if (silentS === 0) note(t('run:silence.ended', { seconds: before }));
}

function followState(message: ServerMessage): void {
  if (message.command === 'state-changed' || message.command === 'snapshot') {
    const { state } = message.data as { state: State };
    followStreams(state);
    followTopics(state);
  }
}

let isWorldUp = false;

/** A world that comes up, or comes back, is told what is listened to. */
function followTopics(state: State): void {
  const wasUp = isWorldUp;
  isWorldUp = state !== 'idle' && state !== 'connected';
  if (!isWorldUp || wasUp) return;
  for (const topic of Object.keys(useTopicsStore.getState().echoes)) {
    // A topic that is not there now is asked for again by whoever opens it.
    send('echo_topic', { topic, max_hz: ECHO_HZ }).catch(() => undefined);
  }
}

let isStreaming = false;

function followStreams(state: State): void {
  const wanted = STREAMING.includes(state);
  if (wanted === isStreaming && wanted) return;
  isStreaming = wanted;
  if (!wanted) return streams.disconnect();
  streams.connect((stream, options) => {
    const done = options ? send('subscribe', { stream, ...options }) : send('unsubscribe', { stream });
    // A stream that this world does not have (no camera, no LIDAR) leaves its view empty, and says so there.
    done.catch(() => undefined);
  });
}

function onLost(reason: string): void {
  isStreaming = false;
  isWorldUp = false;
  stopHeartbeat();
  streams.disconnect();
  set({
    connection: 'reconnecting',
    connectionMessage: reason,
    silentS: 0,
    isLaunching: false,
    progress: null,
  });
  retryTimer = setTimeout(() => void retry(), RETRY_MS[Math.min(attempt, RETRY_MS.length - 1)]);
  attempt += 1;
}

const isOffline = (error: unknown) => error instanceof ApiError && error.isOffline;

/** Why the session was lost, where this page has words of its own for it. */
let lostBecause = '';

/** Why there is no connection, in the user's words where the browser has only its own. */
function reasonOf(error: unknown): string {
  if (isOffline(error)) return t('run:banner.unreachable');
  return error instanceof Error ? error.message : String(error);
}

let isRetrying = false;

async function retry(): Promise<void> {
  if (!session || isRetrying) return;
  isRetrying = true;
  try {
    const found = await api.getSession(session.id);
    if (found.state === 'failed' || found.state === 'ended')
      return onEnded(lostBecause || (found.error ?? ''));
    await openSocket(session);
  } catch (error) {
    if (error instanceof ApiError && error.status === 404) return onEnded('');
    onLost(reasonOf(error));
  } finally {
    isRetrying = false;
  }
}

/** A network that goes away closes no socket: whether the server can be reached without it is asked. */
async function onOffline(): Promise<void> {
  const asked = socket;
  if (!session || !asked?.isOpen) return;
  try {
    await api.getSession(session.id);
  } catch (error) {
    if (!isOffline(error) || asked !== socket) return;
    asked.close();
    onLost(reasonOf(error));
  }
}

/** Back in the network: there is nothing more to wait for. */
function onOnline(): void {
  if (useSessionStore.getState().connection !== 'reconnecting') return;
  clearTimeout(retryTimer);
  void retry();
}

window.addEventListener('offline', () => void onOffline());
window.addEventListener('online', onOnline);

/** The session is gone: its processes ended, and another Run starts a new one. */
function onEnded(reason: string): void {
  stopHeartbeat();
  streams.close();
  socket = null;
  session = null;
  clientId = null;
  resetTopics();
  resetSession({ connection: 'lost', connectionMessage: reason });
}

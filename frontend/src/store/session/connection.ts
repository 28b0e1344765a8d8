import { api } from '@/api/client';
import { ApiError } from '@/api/errors';
import { socketUrl } from '@/api/http';
import type { SessionInfo } from '@/api/types';
import { t } from '@/i18n';
import { serverReason } from '@/i18n/serverReason';
import type { Commands, Introspection, ServerMessage, State } from '@/generated/messages';
import { nextConnection, type ConnectionEvent } from './connectionStates';
import { CommandError, ControlSocket } from './control';
import { initialSession } from './reduce';
import { SilenceWatch } from './silenceWatch';
import { receive, resetSession, useSessionStore } from './store';
import { streams } from './streams';
import { resetTopics, useTopicsStore } from './topics';
import { forgetRun, rememberRun } from './trace/overReload';
import type { SessionData } from './types';

const RETRY_MS = [300, 600, 1200, 2500, 5000];
/** The rate at which a subscribed topic is echoed, in Hz. */
export const ECHO_HZ = 10;
/** The close code of a socket whose session the server ended because the executor did not answer. */
const EXECUTOR_SILENT = 4504;

/** The states of the manager in which it offers streams. */
const STREAMING: readonly State[] = ['visualization_ready', 'application_running', 'paused', 'held'];

const isOffline = (error: unknown) => error instanceof ApiError && error.isOffline;

/** The connection of the page to its project's session; its states are those of `connectionStates.ts`. */
class SessionConnection {
  private socket: ControlSocket | null = null;
  private session: SessionInfo | null = null;
  /** The id by which the manager recognises this page when it reconnects. */
  private clientId: string | null = null;
  private attempt = 0;
  /** Resolves when the previous session has ended; until then the server would return that session again. */
  private ending: Promise<unknown> = Promise.resolve();
  private giveUp: ((error: Error) => void) | null = null;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private isRetrying = false;
  private isWorldUp = false;
  private isStreaming = false;
  /** The translated reason for the loss of the session; empty if the page has none. */
  private lostBecause = '';
  private readonly silence = new SilenceWatch();

  constructor() {
    window.addEventListener('offline', () => void this.onOffline());
    window.addEventListener('online', () => this.onOnline());
  }

  send<K extends keyof Commands>(command: K, data: Commands[K]): Promise<void> {
    return this.socket?.send(command, data) ?? Promise.reject(new Error('There is no session.'));
  }

  /** Starts the project's session, or joins the running one, and waits for the first answer. */
  async ensureConnected(projectId: string): Promise<void> {
    if (this.socket?.isOpen && useSessionStore.getState().projectId === projectId) return;
    this.go('start', { projectId });
    const givenUp = new Promise<never>((_, reject) => {
      this.giveUp = reject;
    });
    const isWanted = () => this.giveUp !== null;
    let session: SessionInfo;
    try {
      const begun = this.ending.then(() => (isWanted() ? api.startSession(projectId) : givenUp));
      session = await Promise.race([begun, givenUp]);
      this.session = session;
      await Promise.race([this.openSocket(session), givenUp]);
    } catch (error) {
      this.go('leave');
      throw error;
    } finally {
      this.giveUp = null;
    }
  }

  /** Stops waiting for a session; a session that was already running continues. */
  async abandonStart(): Promise<void> {
    const starting = this.session;
    this.disconnect();
    if (starting && starting.state !== 'ready') await this.endOnServer(starting.id);
  }

  /** Joins the user's running session of the project: after a reload, or where another window began it. */
  async reattach(projectId: string): Promise<void> {
    useSessionStore.setState({ projectId });
    try {
      const all = await api.ownSessions();
      const found = all.find(({ project_id, state }) => project_id === projectId && state === 'ready');
      if (!found || useSessionStore.getState().connection !== 'off') return;
      this.session = found;
      await this.openSocket(found);
    } catch {
      // It has ended meanwhile; Run starts another one.
    }
  }

  /** Joins a session that follows a program. */
  async join(found: SessionInfo, projectId: string): Promise<void> {
    useSessionStore.setState({ projectId });
    this.session = found;
    await this.openSocket(found);
  }

  /** Ends the session and all its processes. */
  async endSession(): Promise<void> {
    const left = this.session;
    this.disconnect();
    if (left) await this.endOnServer(left.id);
  }

  /** Leaves the session without ending it; called when the project is closed. */
  leave(): void {
    this.disconnect();
    resetSession({ projectId: null, logs: [] });
  }

  /**
   * Sets the state; nothing else does. Returns false for an event without a transition in the table, which is
   * ignored.
   */
  private go(event: ConnectionEvent, change: Partial<SessionData> = {}): boolean {
    const next = nextConnection(useSessionStore.getState().connection, event);
    if (next === null) return false;
    if (event === 'leave' || event === 'ended') resetSession({ ...change, connection: next });
    else useSessionStore.setState({ ...change, connection: next });
    return true;
  }

  private async endOnServer(id: string): Promise<void> {
    const ended = api.endSession(id);
    this.ending = ended.catch(() => undefined);
    await ended;
  }

  private disconnect(): void {
    clearTimeout(this.retryTimer);
    this.giveUp?.(new CommandError('cancelled', 'The start was cancelled.', ''));
    this.socket?.close();
    forgetRun();
    this.dropSession();
    this.go('leave');
  }

  /** Forgets the session and all data that belong to it. */
  private dropSession(): void {
    this.silence.stop();
    streams.close();
    this.socket = null;
    this.session = null;
    this.clientId = null;
    this.isStreaming = false;
    this.isWorldUp = false;
    resetTopics();
  }

  /** Returns the URL of a session's socket for this page. */
  private addressFor(path: string): string {
    const query = this.clientId === null ? '' : `?client=${encodeURIComponent(this.clientId)}`;
    return socketUrl(path) + query;
  }

  /**
   * Opens the control socket. Resolves when the manager has introduced itself; rejects if the socket closes
   * before.
   */
  private openSocket(info: SessionInfo): Promise<void> {
    this.socket?.close();
    return new Promise((resolve, reject) => {
      let isIntroduced = false;
      const opened = new ControlSocket(this.addressFor(info.control_url), {
        onOpen: () => undefined,
        onHeard: () => this.silence.heard(),
        onMessage: (message) => {
          receive(message);
          // Later introductions report a new role of this page, or new abilities of the world.
          if (message.command === 'introspection' && !isIntroduced) {
            isIntroduced = true;
            this.onIntroduced(info, opened, message.data as Introspection);
            resolve();
          }
          this.followState(message);
        },
        onLost: (code, reason) => {
          if (!isIntroduced) return reject(new Error(reason || 'The session did not answer.'));
          this.lostBecause = code === EXECUTOR_SILENT ? t('run:banner.givenUp') : '';
          this.onLost(this.lostBecause || reason);
        },
      });
      this.socket = opened;
      opened.open();
    });
  }

  private onIntroduced(info: SessionInfo, socket: ControlSocket, introspection: Introspection): void {
    this.attempt = 0;
    this.clientId = introspection.client_id;
    rememberRun(info.id);
    this.go('introduced', { connectionMessage: '', sessionId: info.id });
    streams.open(this.addressFor(info.stream_url));
    this.followStreams(introspection.state);
    this.followTopics(introspection.state);
    this.silence.start(socket);
  }

  private followState(message: ServerMessage): void {
    if (message.command === 'state-changed' || message.command === 'snapshot') {
      const { state } = message.data as { state: State };
      this.followStreams(state);
      this.followTopics(state);
    }
  }

  /** Subscribes to the echoed topics again when a world starts or restarts. */
  private followTopics(state: State): void {
    const wasUp = this.isWorldUp;
    this.isWorldUp = state !== 'idle' && state !== 'connected';
    if (!this.isWorldUp || wasUp) return;
    for (const topic of Object.keys(useTopicsStore.getState().echoes)) {
      // A topic that does not exist yet is requested again when it appears.
      this.send('echo_topic', { topic, max_hz: ECHO_HZ }).catch(() => undefined);
    }
  }

  private followStreams(state: State): void {
    const wanted = STREAMING.includes(state);
    if (wanted === this.isStreaming && wanted) return;
    this.isStreaming = wanted;
    if (!wanted) return streams.disconnect();
    streams.connect((stream, options, sensor) => {
      const which = sensor === undefined ? { stream } : { stream, sensor };
      const done = options
        ? this.send('subscribe', { ...which, ...options })
        : this.send('unsubscribe', which);
      // If the world lacks such a stream (no camera, no LIDAR), the view shows a note instead.
      done.catch(() => undefined);
    });
  }

  private onLost(reason: string): void {
    const { waiting, hungSince, goingBack } = initialSession;
    // What lasts is not known any more; the next snapshot says it again.
    const ended = { silentS: 0, isLaunching: false, progress: null, waiting, hungSince, goingBack };
    const change = { connectionMessage: reason, ...ended };
    if (!this.go('closed', change)) return;
    this.isStreaming = false;
    this.isWorldUp = false;
    this.silence.stop();
    streams.disconnect();
    const delay = RETRY_MS[Math.min(this.attempt, RETRY_MS.length - 1)];
    this.retryTimer = setTimeout(() => void this.retry(), delay);
    this.attempt += 1;
  }

  private async retry(): Promise<void> {
    const { session } = this;
    if (!session || this.isRetrying) return;
    this.isRetrying = true;
    try {
      const found = await api.getSession(session.id);
      // The user may have left the project before the server answered.
      if (this.session !== session) return;
      if (found.state === 'failed' || found.state === 'ended')
        return this.onEnded(this.lostBecause || (found.error ?? ''));
      await this.openSocket(session);
    } catch (error) {
      if (error instanceof ApiError && error.status === 404) return this.onEnded('');
      this.onLost(serverReason(error));
    } finally {
      this.isRetrying = false;
    }
  }

  /**
   * Checks the connection when the network is lost, since this closes no socket: a request shows whether the
   * server can still be reached.
   */
  private async onOffline(): Promise<void> {
    const asked = this.socket;
    if (!this.session || !asked?.isOpen) return;
    try {
      await api.getSession(this.session.id);
    } catch (error) {
      if (!isOffline(error) || asked !== this.socket) return;
      asked.close();
      this.onLost(serverReason(error));
    }
  }

  /** Reconnects at once when the network is available again. */
  private onOnline(): void {
    if (useSessionStore.getState().connection !== 'reconnecting') return;
    clearTimeout(this.retryTimer);
    void this.retry();
  }

  /** Handles the end of the session and its processes; Run starts a new session. */
  private onEnded(reason: string): void {
    if (this.go('ended', { connectionMessage: reason })) this.dropSession();
  }
}

const connection = new SessionConnection();

export const send = connection.send.bind(connection) as SessionConnection['send'];
export const ensureConnected = (projectId: string) => connection.ensureConnected(projectId);
export const abandonStart = () => connection.abandonStart();
export const reattach = (projectId: string) => connection.reattach(projectId);
export const joinSession = (found: SessionInfo, projectId: string) => connection.join(found, projectId);
export const endSession = () => connection.endSession();
export const leave = () => connection.leave();

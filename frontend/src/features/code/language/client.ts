import {
  hoverTooltips,
  jumpToDefinitionKeymap,
  LSPClient,
  serverCompletion,
  signatureHelp,
} from '@codemirror/lsp-client';
import type { Extension } from '@codemirror/state';
import { keymap } from '@codemirror/view';
import { notifications } from '@mantine/notifications';
import { t } from '@/i18n';
import { useLanguageStore, type CodeFinding, type LanguageState } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { definitionInTheMiddle } from './definition';
import { renameKeymap } from './rename';
import { sanitizeHtml } from './sanitize';
import { CLOSED, openSocket } from './socket';
import { referencesKeys } from './references';
import { nameOf, pathOf, sourceUriOf, uriOf } from './uris';
import { textOfSource } from './sources';
import { ProjectWorkspace } from './workspace';

const SEVERITIES = ['error', 'error', 'warning', 'info', 'info'] as const;
const RETRY_AFTER_MS = [500, 2000, 8000, 30_000] as const;
const SYNC_AFTER_MS = 700;
/**
 * The longest wait for an answer. The first one comes after the server has read rclpy and all messages, which
 * takes long on a busy machine.
 */
const ANSWER_WITHIN_MS = 60_000;
/** The lifetime after which a server counts as healthy: when it ends, the count of retries starts again. */
const WELL_AFTER_MS = 30_000;

interface Published {
  readonly uri: string;
  readonly version?: number;
  readonly diagnostics: readonly {
    readonly range: { readonly start: CodeFinding['from']; readonly end: CodeFinding['to'] };
    readonly severity?: number;
    readonly message: string;
    readonly code?: string | number;
  }[];
}

function keepFindings({ uri, diagnostics }: Published): void {
  const path = pathOf(uri);
  if (path === null) return;
  const found = diagnostics.map((item): CodeFinding => ({
    from: item.range.start,
    to: item.range.end,
    severity: SEVERITIES[item.severity ?? 1] ?? 'info',
    message: item.message,
    source: `ty ${item.code ?? ''}`.trim(),
  }));
  useLanguageStore.setState(({ findings }) => ({ findings: { ...findings, [path]: found } }));
}

function makeClient(): LSPClient {
  return new LSPClient({
    rootUri: 'file:///project',
    timeout: ANSWER_WITHIN_MS,
    sanitizeHTML: sanitizeHtml,
    workspace: (client) =>
      new ProjectWorkspace(client, (uri) =>
        notifications.show({ message: t('code:language.outside', { where: nameOf(uri) }) }),
      ),
    notificationHandlers: {
      'textDocument/publishDiagnostics': (_client, params: Published) => {
        keepFindings(params);
        return true;
      },
    },
    extensions: [
      serverCompletion(),
      hoverTooltips({ hoverTime: 400 }),
      signatureHelp(),
      keymap.of([...renameKeymap, ...jumpToDefinitionKeymap]),
      referencesKeys,
      definitionInTheMiddle,
    ],
  });
}

const setState = (state: LanguageState) => useLanguageStore.setState({ state });

/**
 * The page's only connection to the language server. It is opened with the first Python file, and again if it
 * breaks.
 */
class Connection {
  readonly client = makeClient();
  private socket: { close(): void } | null = null;
  private retries = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;
  private syncing: ReturnType<typeof setTimeout> | undefined;
  private readonly unwatch: () => void;

  constructor(readonly projectId: string) {
    let counter = useProjectStore.getState().changeCounter;
    this.unwatch = useProjectStore.subscribe((project) => {
      if (project.projectId !== projectId) return leaveLanguage();
      if (project.changeCounter === counter) return;
      counter = project.changeCounter;
      clearTimeout(this.syncing);
      this.syncing = setTimeout(() => {
        this.wake();
      }, SYNC_AFTER_MS);
    });
    this.open();
  }

  /** Sends unsaved texts to the server; reconnects if the server has stopped because it was idle. */
  wake(): void {
    if (this.socket === null && useLanguageStore.getState().state.kind === 'off') this.open();
    else if (this.client.serverCapabilities) this.client.sync();
  }

  retry(): void {
    this.retries = 0;
    clearTimeout(this.timer);
    if (this.socket === null) this.open();
  }

  end(): void {
    this.unwatch();
    clearTimeout(this.timer);
    clearTimeout(this.syncing);
    const { socket } = this;
    this.socket = null;
    this.client.disconnect();
    socket?.close();
    useLanguageStore.setState({ state: { kind: 'off' }, findings: {} });
  }

  private open(): void {
    setState({ kind: 'starting' });
    let readySince: number | null = null;
    const socket = openSocket(this.projectId, {
      open: (transport) => {
        setState({ kind: 'starting' });
        const { initializing } = this.client;
        // The library's notifications wait for the start, and would throw if it fails.
        this.client.initializing = initializing.catch(() => new Promise<never>(() => undefined));
        this.client.connect(transport);
        initializing.then(
          () => {
            readySince = Date.now();
            if (this.socket === socket) setState({ kind: 'ready' });
          },
          () => {
            socket.close();
          },
        );
      },
      waits: ({ before, is_own: isOwn }) => setState({ kind: 'waiting', before: before ?? 0, isOwn }),
      closed: (code, reason) => {
        if (this.socket !== socket) return;
        this.socket = null;
        this.client.disconnect();
        if (readySince !== null && Date.now() - readySince > WELL_AFTER_MS) this.retries = 0;
        this.ended(code, reason);
      },
    });
    this.socket = socket;
  }

  private ended(code: number, reason: string): void {
    if (code === CLOSED.idle) return setState({ kind: 'off' });
    const final = code === CLOSED.unavailable || code === CLOSED.noProject || code === CLOSED.tooMany;
    const delay = final ? undefined : RETRY_AFTER_MS[this.retries];
    this.retries += 1;
    // The findings are removed, since the server that has ended cannot update them.
    useLanguageStore.setState({
      state: { kind: 'failed', reason, willRetry: delay !== undefined },
      findings: {},
    });
    if (delay !== undefined) {
      this.timer = setTimeout(() => {
        this.open();
      }, delay);
    }
  }
}

let connection: Connection | null = null;

/** Connects the open project, unless it is connected; null if none is open. */
function connected(): Connection | null {
  const { projectId } = useProjectStore.getState();
  if (!projectId) return null;
  if (connection?.projectId !== projectId) {
    connection?.end();
    connection = new Connection(projectId);
  }
  connection.wake();
  return connection;
}

/** The extensions that connect a Python editor to the language server; all editors share the connection. */
export function languageSupport(path: string): Extension {
  if (!path.endsWith('.py')) return [];
  return connected()?.client.plugin(uriOf(path), 'python') ?? [];
}

/** The same, for a source outside of the project. */
export const sourceSupport = (path: string): Extension =>
  connected()?.client.plugin(sourceUriOf(path), 'python') ?? [];

/** Wakes the language server for a feature that uses it without an editor. */
export function wakeLanguage(): void {
  connected();
}

/** Reads a source outside of the project, over the socket of the language server. */
export async function readSource(path: string): Promise<string> {
  const client = connected()?.client;
  if (!client) throw new Error(t('code:language.lost'));
  return textOfSource(client, sourceUriOf(path));
}

export function retryLanguage(): void {
  connection?.retry();
}

/** Closes the connection when the page of a project closes. */
function leaveLanguage(): void {
  connection?.end();
  connection = null;
}

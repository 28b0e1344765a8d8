import { api } from '@/api/client';
import { socketUrl } from '@/api/http';
import { useProjectStore } from '@/store/project';
import { mergeRemote } from '@/store/project/remote';
import { saveNow } from './autosave';
import { useSavingStore } from './store';

/** Called after a remote change was applied, with the paths, its message, and the number of lost steps. */
type OnTaken = (
  paths: readonly string[],
  change: { readonly message: string; readonly lost: number },
) => void;

/** Called with the notice to all users of the server; an empty text ends the notice. */
type OnServer = (text: string) => void;

interface ServerNotice {
  readonly type: 'server';
  readonly text: string;
}

interface Notice {
  readonly type: 'revision';
  readonly revision: number;
  readonly author: string;
  readonly message: string;
}

const RETRY_AFTER_MS = [1000, 3000, 10_000, 30_000] as const;
const SIGNED_OUT = 4401;
const NO_SUCH_PROJECT = 4404;

/** Follows the project's revisions and the server's notices; returns a function that stops it. */
export function followRevisions(projectId: string, onTaken: OnTaken, onServer: OnServer): () => void {
  let socket: WebSocket | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let retries = 0;
  let isLeft = false;

  const open = () => {
    socket = new WebSocket(socketUrl(`/ws/projects/${projectId}/notices`));
    socket.onmessage = ({ data }: MessageEvent<string>) => {
      retries = 0;
      const notice = JSON.parse(data) as Notice | ServerNotice;
      if (notice.type === 'server') {
        onServer(notice.text);
        return;
      }
      // A lost answer does no harm, since the next notice or connection repeats it.
      void catchUp(projectId, notice, onTaken).catch(() => undefined);
    };
    socket.onclose = ({ code }) => {
      if (isLeft || code === NO_SUCH_PROJECT || code === SIGNED_OUT) return;
      timer = setTimeout(open, RETRY_AFTER_MS[Math.min(retries, RETRY_AFTER_MS.length - 1)]);
      retries += 1;
    };
  };
  open();
  return () => {
    isLeft = true;
    clearTimeout(timer);
    socket?.close();
  };
}

/** Fetches and applies a revision that someone else made. */
export async function catchUp(projectId: string, notice: Notice, onTaken: OnTaken): Promise<void> {
  const isKnown = () => {
    const { projectId: open, revision } = useProjectStore.getState();
    return open !== projectId || notice.revision <= revision;
  };
  // The server also announces our own save, often before its answer arrives.
  if (!isKnown() && useSavingStore.getState().state.kind === 'saving') await saveNow().catch(() => undefined);
  if (isKnown()) return;
  const detail = await api.getProject(projectId);
  const state = useProjectStore.getState();
  if (state.projectId !== projectId || detail.revision <= state.revision) return;
  const { data, taken, lost } = mergeRemote(state, detail);
  useProjectStore.setState(data);
  if (taken.length > 0) onTaken(taken, { message: notice.message, lost });
}

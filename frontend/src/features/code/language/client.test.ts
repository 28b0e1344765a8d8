import { afterEach, beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { openProject } from '../../../../harness/testing';
import { useLanguageStore } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { languageSupport } from './client';

/** A socket whose server gives places, accepts messages and sends none. */
class SilentSocket {
  static readonly OPEN = 1;
  static opened: SilentSocket[] = [];
  readonly readyState = 1;
  onmessage: (event: { data: string }) => void = () => undefined;
  onclose: (event: { code: number; reason: string }) => void = () => undefined;
  send = vi.fn();

  constructor() {
    SilentSocket.opened.push(this);
  }

  /** Tells the page its turn; null: it has a place. */
  place(before: number | null, is_own = false): void {
    this.onmessage({ data: JSON.stringify({ method: 'bt/place', params: { before, is_own } }) });
  }

  close(): void {
    this.onclose({ code: 1000, reason: '' });
  }
}

const state = () => useLanguageStore.getState().state;

describe('the connection to the language server', () => {
  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal('WebSocket', SilentSocket);
    SilentSocket.opened = [];
    useProjectStore.setState({ projectId: 'p' });
  });
  afterEach(() => {
    useProjectStore.setState({ projectId: null });
    vi.unstubAllGlobals();
    vi.useRealTimers();
  });

  it('reconnects when the server does not answer, and gives up after some attempts', async () => {
    languageSupport('actions/Go.py');
    for (let tries = 1; tries <= 4; tries += 1) {
      SilentSocket.opened.at(-1)?.place(null);
      expect(state()).toEqual({ kind: 'starting' });
      await vi.advanceTimersByTimeAsync(60_000);
      expect(state()).toEqual({ kind: 'failed', reason: '', willRetry: true });
      await vi.advanceTimersByTimeAsync(30_000);
      expect(SilentSocket.opened).toHaveLength(tries + 1);
    }
    SilentSocket.opened.at(-1)?.place(null);
    await vi.advanceTimersByTimeAsync(60_000);
    expect(state()).toEqual({ kind: 'failed', reason: '', willRetry: false });
  });

  it('waits for a place without giving up, and says its turn', async () => {
    languageSupport('actions/Go.py');
    SilentSocket.opened.at(-1)?.place(2);
    expect(state()).toEqual({ kind: 'waiting', before: 2, isOwn: false });
    await vi.advanceTimersByTimeAsync(600_000);
    SilentSocket.opened.at(-1)?.place(0, true);
    expect(state()).toEqual({ kind: 'waiting', before: 0, isOwn: true });
    SilentSocket.opened.at(-1)?.place(null);
    expect(state()).toEqual({ kind: 'starting' });
    expect(SilentSocket.opened).toHaveLength(1);
  });

  it('leaves no error behind when the project is closed before the server answers', async () => {
    const thrown = vi.fn();
    process.on('unhandledRejection', thrown);
    onTestFinished(() => void process.off('unhandledRejection', thrown));
    openProject({ texts: { 'actions/Go.py': 'x = 1\n' } });
    languageSupport('actions/Go.py');
    SilentSocket.opened.at(-1)?.place(null);
    useProjectStore.setState({ projectId: null });
    await vi.advanceTimersByTimeAsync(60_000);
    vi.useRealTimers();
    await new Promise((resolve) => setTimeout(resolve));
    expect(thrown).not.toHaveBeenCalled();
  });
});

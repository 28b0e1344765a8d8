import { afterEach, beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { openProject } from '../../../../harness/testing';
import { useLanguageStore } from '@/store/language';
import { useProjectStore } from '@/store/project';
import { languageSupport } from './client';

/** A socket whose server accepts messages and sends none. */
class SilentSocket {
  static readonly OPEN = 1;
  static opened: SilentSocket[] = [];
  readonly readyState = 1;
  onopen: () => void = () => undefined;
  onclose: (event: { code: number; reason: string }) => void = () => undefined;
  send = vi.fn();

  constructor() {
    SilentSocket.opened.push(this);
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
      SilentSocket.opened.at(-1)?.onopen();
      expect(state()).toEqual({ kind: 'starting' });
      await vi.advanceTimersByTimeAsync(60_000);
      expect(state()).toEqual({ kind: 'failed', reason: '', willRetry: true });
      await vi.advanceTimersByTimeAsync(30_000);
      expect(SilentSocket.opened).toHaveLength(tries + 1);
    }
    SilentSocket.opened.at(-1)?.onopen();
    await vi.advanceTimersByTimeAsync(60_000);
    expect(state()).toEqual({ kind: 'failed', reason: '', willRetry: false });
  });

  it('leaves no error behind when the project is closed before the server answers', async () => {
    const thrown = vi.fn();
    process.on('unhandledRejection', thrown);
    onTestFinished(() => void process.off('unhandledRejection', thrown));
    openProject({ texts: { 'actions/Go.py': 'x = 1\n' } });
    languageSupport('actions/Go.py');
    SilentSocket.opened.at(-1)?.onopen();
    useProjectStore.setState({ projectId: null });
    await vi.advanceTimersByTimeAsync(60_000);
    vi.useRealTimers();
    await new Promise((resolve) => setTimeout(resolve));
    expect(thrown).not.toHaveBeenCalled();
  });
});

import { EditorView } from '@codemirror/view';
import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useLanguageStore, type LanguageState } from '@/store/language';
import { openProject, show } from '../../../harness/testing';
import { SourceTab } from './SourceTab';

const PATH = 'packages/rclpy/node.py';

interface Asked {
  readonly id?: number;
  readonly method: string;
}

/** A server that knows one source. */
class SourceSocket {
  static readonly OPEN = 1;
  static answers: Record<string, object> = {};
  readonly readyState = 1;
  onmessage: (event: { data: string }) => void = () => undefined;
  onclose: (event: { code: number; reason: string }) => void = () => undefined;

  constructor() {
    const place = { method: 'bt/place', params: { before: null, is_own: false } };
    queueMicrotask(() => this.onmessage({ data: JSON.stringify(place) }));
  }

  send(text: string): void {
    const { id, method } = JSON.parse(text) as Asked;
    if (id === undefined) return;
    const answer = SourceSocket.answers[method] ?? { result: { capabilities: {} } };
    queueMicrotask(() => this.onmessage({ data: JSON.stringify({ jsonrpc: '2.0', id, ...answer }) }));
  }

  close(): void {
    this.onclose({ code: 1000, reason: '' });
  }
}

beforeEach(() => {
  vi.stubGlobal('WebSocket', SourceSocket);
  openProject({ texts: {} });
  onTestFinished(() => {
    vi.unstubAllGlobals();
    useLanguageStore.setState(useLanguageStore.getInitialState(), true);
  });
});

describe('SourceTab', () => {
  it('shows a source to read, and says so', async () => {
    SourceSocket.answers = { 'studio/source': { result: { text: 'class Node: ...' } } };
    show(<SourceTab path={PATH} />);
    expect(screen.getByRole('note')).toHaveTextContent('rclpy/node.pyOutside of the project: read-only');
    const text = await screen.findByRole('textbox', { name: 'Source of rclpy/node.py, read-only' });
    const view = EditorView.findFromDOM(text);
    expect(view?.state.doc.toString()).toBe('class Node: ...');
    expect(view?.state.readOnly).toBe(true);
  });

  it('says why a source cannot be shown', async () => {
    SourceSocket.answers = { 'studio/source': { error: { code: -32602, message: 'Not that.' } } };
    show(<SourceTab path={PATH} />);
    expect(await screen.findByRole('alert')).toHaveTextContent('rclpy/node.py cannot be shown: Not that.');
  });

  it('waits for the language server, and says that there is none', () => {
    const state = (next: LanguageState) => act(() => useLanguageStore.setState({ state: next }));
    show(<SourceTab path={PATH} />);
    expect(screen.getByRole('status')).toHaveTextContent('Reading rclpy/node.py…');
    state({ kind: 'failed', reason: 'No room.', willRetry: true });
    expect(screen.queryByRole('alert')).toBeNull();
    state({ kind: 'failed', reason: 'No room.', willRetry: false });
    expect(screen.getByRole('alert')).toHaveTextContent('rclpy/node.py cannot be shown: No room.');
  });
});

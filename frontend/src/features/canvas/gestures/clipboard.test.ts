import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import '@/i18n';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { followClipboard } from './clipboard';

const main: Diagram = {
  ...emptyDiagram('Main'),
  root: 'r',
  nodes: { r: { type: 'Sequence', children: [] } },
};
const types = (): string[] =>
  Object.values(useProjectStore.getState().diagrams['Main']?.nodes ?? {}).map(({ type }) => type);

const words = (): Element => document.querySelector('p')!;

let unfollow: () => void;

beforeEach(() => {
  // jsdom has no layout, so every element in the page counts as visible.
  Element.prototype.checkVisibility = () => true;
  document.body.innerHTML =
    '<div data-testid="canvas" data-tree="Main" tabindex="0"><input /></div><p>words</p>';
  useProjectStore.getState().close();
  useProjectStore.getState().addFile('trees/Main.json', JSON.stringify(main));
  useProjectStore.getState().setActiveTree('Main');
  useProjectStore.getState().select('Main', ['r']);
  unfollow = followClipboard();
});

afterEach(() => {
  unfollow();
  document.body.innerHTML = '';
});

/**
 * Fires the event that a browser sends for Ctrl+C, X or V; returns whether it was handled, and the text that
 * the clipboard then has.
 */
function clipboard(type: 'copy' | 'cut' | 'paste', text = '', target: Element = document.body) {
  let held = text;
  const clipboardData = { getData: () => held, setData: (_: string, value: string) => void (held = value) };
  const event = Object.assign(new Event(type, { bubbles: true, cancelable: true }), { clipboardData });
  target.dispatchEvent(event);
  return { isTaken: event.defaultPrevented, text: held };
}

it('is for the blocks while the canvas has the focus, wherever the caret was', () => {
  document.querySelector<HTMLElement>('[data-testid="canvas"]')?.focus();
  const { text } = clipboard('copy', '', words());
  expect(text).toContain('<Sequence');
  expect(clipboard('paste', '<Sleep msec="5"/>', words()).isTaken).toBe(true);
  expect(types()).toContain('Sleep');
  useProjectStore.getState().select('Main', ['r']);
  clipboard('cut', '', words());
  expect(types()).not.toContain('Sequence');
});

it('is for the tree in front if nothing has the focus and no text is selected', () => {
  expect(clipboard('paste', '<Sleep msec="5"/>').isTaken).toBe(true);
  expect(types()).toContain('Sleep');
  expect(clipboard('copy', '', words()).isTaken).toBe(false);
});

it('is for the text of a field of the canvas', () => {
  const field = document.querySelector('input')!;
  field.focus();
  expect(clipboard('paste', '<Sleep msec="5"/>', field).isTaken).toBe(false);
});

it('does nothing while another document is in front', () => {
  document.querySelector('[data-testid="canvas"]')?.remove();
  expect(clipboard('paste', '<Sleep msec="5"/>').isTaken).toBe(false);
  expect(types()).toEqual(['Sequence']);
});

it('does not replace what was copied while large actions were loaded', async () => {
  const path = 'actions/Big.py';
  const large = { path, kind: 'large', text: null, revision: 1, savedText: null } as const;
  const setLarge = () => useProjectStore.setState(({ files }) => ({ files: { ...files, [path]: large } }));
  const writeText = vi.fn(async () => undefined);
  const clipboards = Object.create(navigator, { clipboard: { value: { writeText } } }) as Navigator;
  vi.stubGlobal('navigator', clipboards);
  const answers: ((response: Response) => void)[] = [];
  vi.stubGlobal('fetch', () => new Promise<Response>((resolve) => answers.push(resolve)));
  const load = async () => {
    answers.shift()?.(new Response('class Big: ...'));
    await vi.waitFor(() => expect(useProjectStore.getState().files[path]?.kind).toBe('text'));
    await new Promise((resolve) => setTimeout(resolve));
  };
  setLarge();
  clipboard('copy');
  clipboard('copy', '', document.querySelector('input')!);
  await load();
  expect(writeText).not.toHaveBeenCalled();
  setLarge();
  clipboard('copy');
  await load();
  expect(writeText).toHaveBeenCalledOnce();
  vi.unstubAllGlobals();
});

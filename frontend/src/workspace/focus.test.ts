import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { focusDocument, focusInspector, letGoOfDocument, selectionKey } from './focus';

const canvas = (): HTMLElement => document.querySelector('[data-testid="canvas"]')!;
const button = (): HTMLElement => document.querySelector('button')!;

beforeEach(() => {
  vi.useFakeTimers();
  // jsdom has no layout, so every element in the page counts as visible.
  Element.prototype.checkVisibility = () => true;
  document.body.innerHTML =
    '<button>Run</button><div data-testid="canvas" data-tree="Main" tabindex="0"></div>';
});

afterEach(() => {
  vi.useRealTimers();
  document.body.innerHTML = '';
});

function leave(how: Event): void {
  window.dispatchEvent(how);
  button().focus();
}

it('takes the focus back from a menu that closes late', () => {
  focusDocument({ kind: 'tree', id: 'Main' });
  vi.advanceTimersByTime(50);
  button().focus();
  vi.advanceTimersByTime(50);
  expect(document.activeElement).toBe(canvas());
});

it.each([
  ['by Tab', () => new KeyboardEvent('keydown', { key: 'Tab' })],
  ['by the pointer', () => new Event('pointerdown')],
])('does not take the focus from a user who moves on %s', (_, how) => {
  focusDocument({ kind: 'tree', id: 'Main' });
  vi.advanceTimersByTime(50);
  expect(document.activeElement).toBe(canvas());
  leave(how());
  vi.advanceTimersByTime(1000);
  expect(document.activeElement).toBe(button());
});

it('waits for a document that is loading, while the user types ahead', () => {
  const late = canvas();
  late.remove();
  focusDocument({ kind: 'tree', id: 'Main' });
  vi.advanceTimersByTime(1000);
  window.dispatchEvent(new KeyboardEvent('keydown', { key: 'a' }));
  document.body.append(late);
  vi.advanceTimersByTime(50);
  expect(document.activeElement).toBe(late);
});

it('leaves the focus alone after the wait', () => {
  focusDocument({ kind: 'tree', id: 'Main' });
  vi.advanceTimersByTime(1000);
  button().focus();
  vi.advanceTimersByTime(1000);
  expect(document.activeElement).toBe(button());
});

it('is cancelled by a later request', () => {
  focusDocument({ kind: 'tree', id: 'Main' });
  vi.advanceTimersByTime(50);
  letGoOfDocument();
  button().focus();
  vi.advanceTimersByTime(1000);
  expect(document.activeElement).toBe(button());
});

/** The inspector with a field, as it shows a block of the tree `Main`. */
const inspectorOf = (node: string) =>
  `<div data-testid="inspector" data-selection="${selectionKey('Main', 1, node)}"><input /></div>`;

it('is cancelled by the fields of the block, too', () => {
  useProjectStore.setState({ activeTree: 'Main', selection: ['n2'] });
  document.body.insertAdjacentHTML('beforeend', inspectorOf('n2'));
  focusDocument({ kind: 'tree', id: 'Main' });
  vi.advanceTimersByTime(50);
  focusInspector();
  vi.advanceTimersByTime(1000);
  expect(document.activeElement).toBe(document.querySelector('input'));
});

it('waits for the fields of the block that was just selected', () => {
  useProjectStore.setState({ activeTree: 'Main', selection: ['n3'] });
  document.body.innerHTML = inspectorOf('n2');
  focusInspector();
  vi.advanceTimersByTime(500);
  expect(document.activeElement).toBe(document.body);
  document.body.innerHTML = inspectorOf('n3');
  vi.advanceTimersByTime(50);
  expect(document.activeElement).toBe(document.querySelector('input'));
});

it.each(['port-speed', 'condition-speed'])('moves into the field that is asked for: %s', (field) => {
  useProjectStore.setState({ activeTree: 'Main', selection: ['n3'] });
  document.body.innerHTML = inspectorOf('n3').replace(
    '<input />',
    `<input data-testid="port-a" /><textarea data-testid="${field}"></textarea>`,
  );
  focusInspector('speed');
  expect(document.activeElement).toBe(document.querySelector('textarea'));
});

it('moves into the first field where the one that is asked for is missing', () => {
  useProjectStore.setState({ activeTree: 'Main', selection: ['n3'] });
  document.body.innerHTML = inspectorOf('n3');
  focusInspector('"] gone');
  expect(document.activeElement).toBe(document.querySelector('input'));
});

it('leaves the focus alone when the user moves on before the fields are there', () => {
  useProjectStore.setState({ activeTree: 'Main', selection: ['n3'] });
  document.body.innerHTML = inspectorOf('n2');
  focusInspector();
  window.dispatchEvent(new KeyboardEvent('keydown', { key: 'Tab' }));
  document.body.innerHTML = inspectorOf('n3');
  vi.advanceTimersByTime(500);
  expect(document.activeElement).toBe(document.body);
});

it('leaves the focus to a field of the document that got it meanwhile', () => {
  document.body.innerHTML =
    '<div role="tabpanel"><input><div data-testid="code-editor" data-path="a.py">' +
    '<div class="cm-content" tabindex="0"></div></div></div>';
  focusDocument({ kind: 'file', path: 'a.py' });
  vi.advanceTimersByTime(50);
  expect(document.activeElement).toBe(document.querySelector('.cm-content'));
  document.querySelector('input')!.focus();
  vi.advanceTimersByTime(1000);
  expect(document.activeElement).toBe(document.querySelector('input'));
});

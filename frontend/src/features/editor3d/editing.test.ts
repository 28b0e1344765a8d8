import { notifications } from '@mantine/notifications';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { lookOnly, openRobot, openUniverse, ROBOT, UNIVERSE, URDF } from '../../../harness/documents';
import {
  change,
  editorFor,
  followTexts,
  restart,
  select,
  showIn,
  textsOf,
  toggle,
  travel,
  TURN_STEP,
  type Editor,
} from './editing';

const textAt = (path: string) => useProjectStore.getState().currentText(path);
const state = (editor: Editor) => editor.store.getState();
const labels = (editor: Editor) => state(editor).undoStack.past.map(({ label }) => label);
const add = (editor: Editor, word: string, mergeKey?: string) =>
  change(editor, word, () => ({ texts: [`${textsOf(editor)[0] ?? ''}# ${word}\n`] }), mergeKey);

describe('an editor', () => {
  it('starts without a selection, and with the text if there is no WebGL', () => {
    expect(state(openUniverse())).toMatchObject({
      selection: [],
      waypoint: null,
      mode: 'move',
      tool: 'select',
      canPlace: true,
      viewpoint: { kind: 'default' },
      isTextShown: true,
      shownText: 0,
    });
    expect(TURN_STEP).toBeCloseTo(0.2618, 4);
  });

  it('knows all texts of its document', () => {
    expect(textsOf(openUniverse())).toEqual([textAt(UNIVERSE)]);
    expect(textsOf(openRobot())).toEqual([textAt(ROBOT), textAt(URDF)]);
    expect(textsOf(openUniverse(''))).toEqual(['']);
  });

  it('knows the view that shows it', () => {
    const editor = openUniverse();
    const view = { center: () => [0, 0] as const, forward: () => [1, 0] as const, cancel: () => false };
    showIn(editor, view);
    expect(editor.view).toBe(view);
    showIn(editor, null);
    expect(editor.view).toBeNull();
  });
});

describe('a large text', () => {
  const large = (path: string) =>
    useProjectStore.setState(({ files }) => ({
      files: { ...files, [path]: { ...files[path]!, kind: 'large', text: null, savedText: null } },
    }));
  const arrives = (path: string, text: string) =>
    useProjectStore.setState(({ files }) => ({
      files: { ...files, [path]: { ...files[path]!, kind: 'text', text, savedText: text } },
    }));

  it.each([
    [openRobot, ROBOT, URDF],
    [openUniverse, UNIVERSE, UNIVERSE],
  ])('is no undo step when it arrives', (open, path, file) => {
    const first = open();
    large(file);
    // An editor that is made while the text is large.
    useProjectStore.setState(({ projectId }) => ({ projectId: `${projectId ?? ''}-large` }));
    const editor = editorFor(path, first.kind);
    for (const each of [first, editor]) followTexts(each);
    arrives(file, 'whole');
    for (const each of [first, editor]) {
      followTexts(each);
      expect(labels(each)).toEqual([]);
      travel(each, 'undo');
    }
    expect(textAt(file)).toBe('whole');
    add(editor, 'one');
    travel(editor, 'undo');
    expect([textAt(file), labels(editor)]).toEqual(['whole', []]);
  });
});

it('a document that was replaced as a whole begins again', () => {
  const editor = openUniverse('a: 1\n');
  select(editor, ['x']);
  add(editor, 'one');
  useProjectStore.getState().setFileText(UNIVERSE, 'b: 1\n');
  restart(UNIVERSE);
  restart('universes/unknown.yaml');
  expect(state(editor)).toMatchObject({ selection: [], undoStack: { past: [], texts: ['b: 1\n'] } });
});

describe('a change', () => {
  it('is written, in one undo step with the selection before and after', () => {
    const editor = openUniverse('a: 1\n');
    select(editor, ['x']);
    change(editor, 'move', () => ({ texts: ['a: 2\n'], select: ['y'] }));
    expect(textAt(UNIVERSE)).toBe('a: 2\n');
    expect(state(editor).selection).toEqual(['y']);
    expect(state(editor).undoStack.past).toMatchObject([{ label: 'move', before: ['x'], after: ['y'] }]);
  });

  it('is merged with the last one of the same key, but not after a new selection', () => {
    const editor = openUniverse('');
    add(editor, 'one', 'key');
    add(editor, 'two', 'key');
    expect(labels(editor)).toEqual(['one']);
    select(editor, []);
    add(editor, 'three', 'key');
    expect(labels(editor)).toEqual(['one', 'three']);
    add(editor, 'four');
    add(editor, 'five');
    expect(labels(editor)).toEqual(['one', 'three', 'four', 'five']);
  });

  it('keeps the selected waypoint as long as the selection stays', () => {
    const editor = openUniverse('');
    select(editor, ['walker'], 2);
    change(editor, 'way', () => ({ texts: ['a'], select: ['walker'] }));
    expect(state(editor).waypoint).toBe(2);
    change(editor, 'way', () => ({ texts: ['b'], select: ['other'] }));
    expect(state(editor).waypoint).toBeNull();
    select(editor, ['walker'], 1);
    change(editor, 'way', () => ({ texts: ['c'], select: ['walker', 'other'] }));
    expect(state(editor).waypoint).toBeNull();
  });

  it('without content is no step, and one that cannot be written is explained', () => {
    const editor = openUniverse('a: 1\n');
    change(editor, 'nothing', () => null);
    expect(labels(editor)).toEqual([]);
    const shown = vi.spyOn(notifications, 'show');
    change(editor, 'bad', () => {
      throw new Error('anchors');
    });
    expect(shown).toHaveBeenCalledWith({ color: 'red', message: expect.stringMatching(/anchors \(&, \*\)/) });
    expect(labels(editor)).toEqual([]);
    expect(textAt(UNIVERSE)).toBe('a: 1\n');
  });

  it('in a read-only project is refused, and so is undo', () => {
    const editor = openUniverse('');
    add(editor, 'one');
    lookOnly();
    onTestFinished(() => useProjectStore.setState({ role: 'owner' }));
    add(editor, 'two');
    travel(editor, 'undo');
    expect(textAt(UNIVERSE)).toBe('# one\n');
  });

  it('first records changes of the text from elsewhere', () => {
    const editor = openUniverse('a: 1\n');
    useProjectStore.getState().setFileText(UNIVERSE, 'a: 2\n');
    add(editor, 'move');
    expect(labels(editor)).toEqual(['text', 'move']);
    travel(editor, 'undo');
    travel(editor, 'undo');
    expect(textAt(UNIVERSE)).toBe('a: 1\n');
  });
});

describe('followTexts', () => {
  it('merges typing, and records nothing without a change', () => {
    const editor = openUniverse('a');
    const before = state(editor);
    followTexts(editor);
    expect(state(editor)).toBe(before);
    for (const text of ['ab', 'abc']) {
      useProjectStore.getState().setFileText(UNIVERSE, text);
      followTexts(editor);
    }
    expect(labels(editor)).toEqual(['text']);
  });
});

describe('undo and redo', () => {
  it('go through the steps, with their selections', () => {
    const editor = openUniverse('models: [{id: a, shape: box}, {id: b, shape: box}]\n');
    select(editor, ['a']);
    change(editor, 'one', () => ({ texts: ['models: [{id: b, shape: box}]\n'], select: ['b'] }));
    select(editor, ['b'], 1);
    travel(editor, 'undo');
    expect(textAt(UNIVERSE)).toContain('{id: a, shape: box}');
    expect(state(editor)).toMatchObject({ selection: ['a'], waypoint: null });
    travel(editor, 'undo');
    expect(state(editor).selection).toEqual(['a']);
    travel(editor, 'redo');
    expect(textAt(UNIVERSE)).toBe('models: [{id: b, shape: box}]\n');
    expect(state(editor).selection).toEqual(['b']);
    travel(editor, 'redo');
    expect(state(editor).undoStack.future).toEqual([]);
  });

  it('select only things that exist afterwards', () => {
    const editor = openUniverse('models: []\n');
    select(editor, ['gone']);
    change(editor, 'one', () => ({ texts: ['models: [] \n'], select: ['also gone'] }));
    travel(editor, 'undo');
    expect(state(editor).selection).toEqual([]);
  });

  it('write every file of a document', () => {
    const editor = openRobot();
    const before = textsOf(editor);
    change(editor, 'both', () => ({ texts: before.map((text) => `${text}\n`) }));
    expect(textAt(URDF)).toBe(`${before[1]}\n`);
    travel(editor, 'undo');
    expect([textAt(ROBOT), textAt(URDF)]).toEqual(before);
  });

  it('do not create a missing file', () => {
    const editor = openRobot();
    useProjectStore.getState().deleteFile(URDF);
    change(editor, 'yaml', () => ({ texts: ['urdf: robot.urdf\n', '<robot/>'] }));
    expect([textAt(ROBOT), textAt(URDF)]).toEqual(['urdf: robot.urdf\n', null]);
  });
});

describe('the selection', () => {
  it('toggles one thing', () => {
    const editor = openUniverse();
    toggle(editor, 'a');
    toggle(editor, 'b');
    expect(state(editor).selection).toEqual(['a', 'b']);
    toggle(editor, 'a');
    expect(state(editor).selection).toEqual(['b']);
  });

  it('clears the selected waypoint unless it names one', () => {
    const editor = openUniverse();
    select(editor, ['a'], 0);
    expect(state(editor).waypoint).toBe(0);
    select(editor, ['a']);
    expect(state(editor).waypoint).toBeNull();
  });
});

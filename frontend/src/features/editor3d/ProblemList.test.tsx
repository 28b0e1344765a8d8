import { readFileSync } from 'node:fs';
import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { rewrite } from '@/model/document/rewrite';
import type { DocumentProblem } from '@/model/document/yaml';
import { readUniverse } from '@/model/universe/read';
import { useProjectStore } from '@/store/project';
import { openUniverse } from '../../../harness/documents';
import { show, user, watchNavigation } from '../../../harness/testing';
import { change, textsOf, travel } from './editing';
import { ProblemList } from './ProblemList';

const problem = (more: Partial<DocumentProblem> = {}): DocumentProblem => ({
  path: ['models', 0, 'mass'],
  kind: 'number',
  params: {},
  text: 0,
  line: 7,
  column: 1,
  thing: null,
  ...more,
});

const ONE = ['universes/hall.yaml'];
const TWO = ['robots/mine/robot.yaml', 'robots/mine/robot.urdf'];

describe('ProblemList', () => {
  it('is absent without problems', () => {
    show(<ProblemList problems={[]} paths={ONE} title="0 problems" />);
    expect(screen.queryByRole('heading')).toBeNull();
  });

  it('shows the place and the message of each', () => {
    show(
      <ProblemList
        problems={[problem(), problem({ kind: 'missing', params: { name: 'shape' }, line: 9 })]}
        paths={ONE}
        title="2 problems"
      />,
    );
    expect(screen.getByRole('heading', { name: '2 problems' })).toBeInTheDocument();
    const [first, second] = screen.getAllByRole('button');
    expect(first).toHaveTextContent(/^Line 7models\.0\.mass must be a number$/);
    expect(second).toHaveTextContent(/^Line 9 shape is missing$/);
  });

  it('names the file if there are several', () => {
    show(<ProblemList problems={[problem({ text: 1, path: [] })]} paths={TWO} title="1 problem" />);
    expect(screen.getByRole('button')).toHaveTextContent(/^robot\.urdf · Line 7 must be a number$/);
  });

  it('lists fifty at most', () => {
    const many = Array.from({ length: 51 }, () => problem());
    show(<ProblemList problems={many} paths={ONE} title="51 problems" />);
    expect(screen.getAllByRole('button')).toHaveLength(50);
  });

  it('opens the line, shows the text, and selects the thing', async () => {
    const { openFile, aimAt } = watchNavigation();
    const editor = openUniverse();
    editor.store.setState({ isTextShown: false });
    show(<ProblemList problems={[problem({ thing: 'crate' })]} paths={ONE} title="1" editor={editor} />);
    await user.click(screen.getByRole('button'));
    expect(editor.store.getState()).toMatchObject({ isTextShown: true, shownText: 0, selection: ['crate'] });
    expect(openFile).toHaveBeenCalledExactlyOnceWith('universes/hall.yaml', 7);
    expect(aimAt).not.toHaveBeenCalled();
  });

  it('stays in the editor for its second text, and keeps the selection', async () => {
    const { openFile, aimAt } = watchNavigation();
    const editor = openUniverse();
    editor.store.setState({ selection: ['ball'] });
    show(<ProblemList problems={[problem({ text: 1 })]} paths={TWO} title="1" editor={editor} />);
    await user.click(screen.getByRole('button'));
    expect(editor.store.getState()).toMatchObject({ shownText: 1, selection: ['ball'] });
    expect(aimAt).toHaveBeenCalledExactlyOnceWith('robots/mine/robot.urdf', 7);
    expect(openFile).not.toHaveBeenCalled();
  });

  it('opens the file without an editor, and nothing without a file', async () => {
    const { openFile } = watchNavigation();
    show(<ProblemList problems={[problem({ text: 1 }), problem({ text: 2 })]} paths={TWO} title="2" />);
    const [there, gone] = screen.getAllByRole('button');
    await user.click(there!);
    expect(openFile).toHaveBeenCalledExactlyOnceWith('robots/mine/robot.urdf', 7);
    await user.click(gone!);
    expect(openFile).toHaveBeenCalledOnce();
  });

  it('writes what a problem says, and takes it back by one undo', async () => {
    const editor = openUniverse();
    const before = useProjectStore.getState().currentText(editor.path) ?? '';
    change(editor, 'old', () => ({
      texts: [rewrite(before, [{ kind: 'set', path: ['name'], value: true }])],
    }));
    const [issue] = readUniverse(textsOf(editor)[0] ?? '').problems;
    expect(issue).toMatchObject({ kind: 'textWrite', params: { write: '"true"' } });
    show(<ProblemList problems={issue ? [issue] : []} paths={ONE} title="1" editor={editor} />);
    await user.click(screen.getByRole('button', { name: 'Write "true"' }));
    expect(readUniverse(textsOf(editor)[0] ?? '')).toMatchObject({
      universe: { name: 'true' },
      problems: [],
    });
    travel(editor, 'undo');
    expect(textsOf(editor)[0]).toContain('name: true');
  });

  it.each([
    ['.5', 0.5],
    ['5.', 5],
    ['+5', 5],
    ['007', 7],
  ])('writes %s as the number %d, and keeps the focus', async (write, value) => {
    const editor = openUniverse();
    const issue = problem({ path: ['models', 1, 'mass'], params: { write } });
    show(<ProblemList problems={[issue, problem()]} paths={ONE} title="2 problems" editor={editor} />);
    await user.click(screen.getByRole('button', { name: `Write ${write}` }));
    expect(textsOf(editor)[0]).toContain(`mass: ${value}`);
    expect(screen.getByRole('region', { name: '2 problems' })).toHaveFocus();
  });

  it('leaves the focus to the editor with its last problem', async () => {
    const editor = openUniverse();
    const issue = problem({ path: ['models', 1, 'mass'], params: { write: '5' } });
    show(
      <div tabIndex={-1} data-testid="editor">
        <ProblemList problems={[issue]} paths={ONE} title="1 problem" editor={editor} />
      </div>,
    );
    await user.click(screen.getByRole('button', { name: 'Write 5' }));
    expect(screen.getByTestId('editor')).toHaveFocus();
  });

  it('lets only the line of a problem look like a line: the repair is a button', () => {
    const sheet = readFileSync('src/features/editor3d/editor3d.module.css', 'utf-8');
    const rules = [...sheet.matchAll(/^\.problems [^{]*button[^{]*(?= \{)/gm)].map(([rule]) => rule);
    expect(rules.length).toBeGreaterThan(0);
    expect(rules.filter((rule) => !rule.includes('> button:first-child'))).toEqual([]);
  });
});

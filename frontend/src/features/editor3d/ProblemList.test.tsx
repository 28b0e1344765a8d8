import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { DocumentProblem } from '@/model/document/yaml';
import { openUniverse } from '../../../harness/documents';
import { show, user, watchNavigation } from '../../../harness/testing';
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
});

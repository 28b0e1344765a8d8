import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { useEditorStore } from '@/store/project/editor';
import { forgetEditor } from '../../../harness/canvas';
import { shownTarget } from '../../../harness/target';
import { action, nodeOf, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { NodeHeader } from './NodeHeader';

const Header = shownTarget('Main', NodeHeader);
const field = () => screen.getByRole('textbox', { name: 'Name' });
const buttons = () => screen.getAllByRole('button').map(({ textContent }) => textContent);

beforeEach(() => {
  forgetEditor();
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['a', 's', 'n'] },
        a: { type: 'Drive', name: 'Go' },
        s: { type: 'SubTree', tree: 'Dock' },
        n: { type: 'SubTree' },
      },
    },
    actions: [action('Drive')],
    selected: ['a'],
  });
});

describe('the name', () => {
  it('is that of the block; without it, the type is the name', async () => {
    show(<Header id="a" />);
    expect(field()).toHaveValue('Go');
    expect(field()).toHaveAttribute('placeholder', 'Drive');
    await user.clear(field());
    expect(nodeOf('Main', 'a')?.name).toBeUndefined();
    expect(field()).toHaveValue('');
  });

  it('of a subtree is that of its tree', () => {
    show(<Header id="s" />);
    expect(field()).toHaveValue('');
    expect(field()).toHaveAttribute('placeholder', 'Dock');
  });

  it('keeps its blanks while it is typed, and the document has none around it', async () => {
    show(<Header id="a" />);
    await user.type(field(), ' to');
    expect(field()).toHaveValue('Go to');
    await user.type(field(), ' ');
    expect(field()).toHaveValue('Go to ');
    expect(nodeOf('Main', 'a')?.name).toBe('Go to');
    await user.tab();
    expect(field()).toHaveValue('Go to');
  });

  it('may start like the type', async () => {
    show(<Header id="a" />);
    await user.clear(field());
    await user.type(field(), 'Drive');
    expect(field()).toHaveValue('Drive');
    expect(nodeOf('Main', 'a')?.name).toBeUndefined();
    await user.type(field(), ' on');
    expect(field()).toHaveValue('Drive on');
    expect(nodeOf('Main', 'a')?.name).toBe('Drive on');
  });

  it("of a subtree may start like its tree's", async () => {
    show(<Header id="s" />);
    await user.type(field(), 'Dock');
    expect(field()).toHaveValue('Dock');
    expect(nodeOf('Main', 's')?.name).toBeUndefined();
  });

  it('follows a change from elsewhere', async () => {
    show(<Header id="a" />);
    await user.type(field(), ' to');
    act(() => useProjectStore.getState().undo());
    expect(field()).toHaveValue('Go');
  });
});

describe('the buttons', () => {
  it.each([
    ['r', ['Change type']],
    ['a', ['Change type', 'Open code']],
    ['s', ['Change type', 'Open tree']],
    ['n', ['Change type']],
  ])('of %s are %o', (id, expected) => {
    show(<Header id={id} />);
    expect(buttons()).toEqual(expected);
  });

  it('open other types below the button', async () => {
    show(<Header id="r" />);
    const button = screen.getByRole('button', { name: 'Change type' });
    button.getBoundingClientRect = () => new DOMRect(30, 40, 90, 20);
    await user.click(button);
    expect(useEditorStore.getState().quickAdd).toEqual({
      tree: 'Main',
      goal: { does: 'morph', node: 'r' },
      x: 30,
      y: 64,
      text: '',
    });
  });

  it('open the code and the tree', async () => {
    const { openFile, openTree } = watchNavigation();
    show(<Header id="a" />);
    await user.click(screen.getByTestId('open-code'));
    expect(openFile).toHaveBeenCalledWith('actions/Drive.py');
    show(<Header id="s" />);
    await user.click(screen.getByRole('button', { name: 'Open tree' }));
    expect(openTree).toHaveBeenCalledWith('Dock');
  });
});

import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { openRobot, ROBOT, URDF } from '../../../harness/documents';
import { fakeServer, show, user } from '../../../harness/testing';
import { EditorFrame } from './EditorFrame';

const PROBLEM = { path: [], kind: 'number', params: {}, text: 0, line: 3, column: 1, thing: null };

function frame(more: Partial<Parameters<typeof EditorFrame>[0]> = {}, isTextShown = false) {
  fakeServer({});
  const editor = openRobot();
  editor.store.setState({ isTextShown });
  show(
    <EditorFrame
      editor={editor}
      testId="frame"
      paths={[ROBOT, URDF]}
      problems={[]}
      words={{ unreadable: 'It cannot be shown', problems: '1 problem' }}
      toolbar={<p>tools</p>}
      {...more}
    >
      {'children' in more ? more.children : <p>view</p>}
    </EditorFrame>,
  );
  return editor;
}

const texts = () => screen.queryAllByRole('radio').map((radio) => (radio as HTMLInputElement).value);

describe('EditorFrame', () => {
  it('shows tools and view, and the text only on demand', () => {
    const editor = frame();
    expect(screen.getByTestId('frame')).toHaveAttribute('data-path', ROBOT);
    expect(screen.getByText('tools')).toBeInTheDocument();
    expect(screen.getByText('view')).toBeInTheDocument();
    expect(texts()).toEqual([]);
    act(() => editor.store.setState({ isTextShown: true }));
    expect(texts()).toEqual([ROBOT, URDF]);
  });

  it('switches between the texts', async () => {
    const editor = frame({}, true);
    expect(screen.getByRole('radiogroup', { name: 'Which file' })).toBeInTheDocument();
    expect(screen.getByRole('radio', { name: 'robot.yaml' })).toBeChecked();
    await user.click(screen.getByRole('radio', { name: 'robot.urdf' }));
    expect(editor.store.getState().shownText).toBe(1);
    expect(screen.getByRole('radio', { name: 'robot.urdf' })).toBeChecked();
  });

  it('offers no choice for a single text, and shows that its editor is loading', () => {
    frame({ paths: [ROBOT] }, true);
    expect(texts()).toEqual([]);
    expect(screen.getByText('Loading the text editor')).toBeInTheDocument();
  });

  it('shows the first text if the chosen one was deleted', () => {
    const editor = frame({}, true);
    act(() => editor.store.setState({ shownText: 5 }));
    expect(screen.getByRole('radio', { name: 'robot.yaml' })).toBeChecked();
  });

  it('reports that a document cannot be shown, and offers its text', async () => {
    const editor = frame({ children: null });
    expect(screen.getByRole('alert')).toHaveTextContent('It cannot be shown');
    await user.click(screen.getByRole('button', { name: 'Show the text' }));
    expect(editor.store.getState().isTextShown).toBe(true);
    expect(screen.queryByRole('button', { name: 'Show the text' })).toBeNull();
  });

  it('lists the problems', () => {
    frame({ problems: [PROBLEM] });
    expect(screen.getByRole('heading', { name: '1 problem' })).toBeInTheDocument();
  });

  it('shows text and problems alone if there is no file', () => {
    frame({ paths: [], problems: [PROBLEM] });
    expect(screen.getByTestId('frame-text')).toBeInTheDocument();
    expect(screen.queryByText('tools')).toBeNull();
    expect(screen.queryByText('view')).toBeNull();
    expect(screen.getByRole('heading', { name: '1 problem' })).toBeInTheDocument();
  });
});

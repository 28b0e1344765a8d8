import { screen, waitFor } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { EMPTY_STL, openRobot, showRobot, stl, takesFile } from '../../../harness/documents';
import { fakeServer, user } from '../../../harness/testing';
import type { RobotEditor } from './editor';
import { useBringMesh } from './useBringMesh';

function Bring({ editor, onMesh }: { readonly editor: RobotEditor; readonly onMesh: () => void }) {
  const { ask, input } = useBringMesh(editor, 'file', onMesh);
  return (
    <>
      <button onClick={ask}>Bring</button>
      {input}
    </>
  );
}

function begin() {
  const editor = openRobot();
  const onMesh = vi.fn();
  showRobot(editor, () => <Bring editor={editor} onMesh={onMesh} />);
  return { onMesh, input: screen.getByTestId<HTMLInputElement>('file') };
}

describe('useBringMesh', () => {
  it('asks for a file of a readable kind', async () => {
    const { input } = begin();
    expect(input).not.toBeVisible();
    expect(input.accept).toBe('.stl,.obj,.dae,.ply,.glb');
    const opened = vi.spyOn(input, 'click').mockImplementation(() => undefined);
    await user.click(screen.getByRole('button', { name: 'Bring' }));
    expect(opened).toHaveBeenCalledOnce();
  });

  it('passes the mesh on; the same file can be chosen again', async () => {
    const { input, onMesh } = begin();
    fakeServer(takesFile('robots/mine/meshes/arm.stl'));
    await user.upload(input, new File([stl(1)], 'arm.stl'));
    await waitFor(() => expect(onMesh).toHaveBeenCalledExactlyOnceWith({ file: 'meshes/arm.stl', scale: 1 }));
    expect(input.value).toBe('');
  });

  it('passes nothing on for an unreadable file', async () => {
    const { input, onMesh } = begin();
    fakeServer({});
    await user.upload(input, new File([EMPTY_STL], 'arm.stl'));
    expect(await screen.findByText(/arm\.stl cannot be used/)).toBeInTheDocument();
    expect(onMesh).not.toHaveBeenCalled();
  });
});

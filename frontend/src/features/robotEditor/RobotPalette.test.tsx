import { screen, waitFor } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { ADDABLE } from '@/model/robot/parts';
import { openRobot, showRobot, stl, takesFile } from '../../../harness/documents';
import { fakeServer, user } from '../../../harness/testing';
import { RobotPalette } from './RobotPalette';

function palette(texts: Record<string, string> = {}) {
  const editor = openRobot(texts);
  return { editor, robot: showRobot(editor, () => <RobotPalette editor={editor} />) };
}

describe('the palette of a robot', () => {
  it('adds each kind of part', async () => {
    const { editor, robot } = palette();
    for (const kind of ADDABLE) {
      const before = robot().parts.length;
      await user.click(screen.getByTestId(`add-${kind}`));
      expect(robot().parts).toHaveLength(before + 1);
      expect(robot().parts.map(({ key }) => key)).toContain(editor.store.getState().selection[0]);
    }
    expect(screen.getByRole('button', { name: 'Place: Depth camera' })).toBe(screen.getByTestId('add-depth'));
    expect(screen.getByRole('toolbar', { name: 'Parts to add' })).toBeInTheDocument();
  });

  it('shows that there are no meshes yet, and uploads one', async () => {
    const { robot } = palette();
    await user.click(screen.getByTestId('add-mesh'));
    expect(await screen.findByText('This robot has no meshes yet')).toBeInTheDocument();
    const input = screen.getByTestId<HTMLInputElement>('part-mesh-file');
    const opened = vi.spyOn(input, 'click').mockImplementation(() => undefined);
    await user.click(screen.getByRole('menuitem', { name: /Bring a mesh/ }));
    expect(opened).toHaveBeenCalledOnce();
    fakeServer(takesFile('robots/mine/meshes/arm.stl'));
    await user.upload(input, new File([stl(400)], 'arm.stl'));
    await waitFor(() =>
      expect([...robot().urdf.links.values()].at(-1)?.visuals).toMatchObject([
        { file: 'meshes/arm.stl', size: [0.001, 0.001, 0.001] },
      ]),
    );
  });

  it('offers the meshes in the folder of the URDF', async () => {
    const { robot } = palette({ 'robots/mine/meshes/a.stl': '', 'assets/b.stl': '' });
    await user.click(screen.getByTestId('add-mesh'));
    expect(await screen.findByText('Of this robot')).toBeInTheDocument();
    expect(screen.queryByText('assets/b.stl')).toBeNull();
    await user.click(screen.getByRole('menuitem', { name: 'meshes/a.stl' }));
    expect([...robot().urdf.links.values()].at(-1)?.visuals).toMatchObject([
      { file: 'meshes/a.stl', size: [1, 1, 1] },
    ]);
  });
});

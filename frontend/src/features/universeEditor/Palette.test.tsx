import { act, screen, waitFor } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { showIn } from '@/features/editor3d/editing';
import { EMPTY_STL, openUniverse, showUniverse, stl, takesFile } from '../../../harness/documents';
import { fakeServer, user } from '../../../harness/testing';
import { KINDS } from './commands';
import { Palette } from './Palette';

const ROBOTS = [
  { id: 'turtle2', name: 'Turtle', description: '' },
  { id: 'mine', name: 'Theirs', description: '' },
];

function palette(others: Readonly<Record<string, string>> = {}, answers = {}) {
  const server = fakeServer({ 'GET /catalog/robots': ROBOTS, ...answers });
  const editor = openUniverse(undefined, others);
  return { editor, server, ...showUniverse(editor, () => <Palette editor={editor} />) };
}

describe('the palette of a universe', () => {
  it('places each kind of thing by a click', async () => {
    const { universe } = palette();
    const before = universe().things.length;
    for (const kind of KINDS) await user.click(screen.getByTestId(`place-${kind}`));
    expect(universe().things).toHaveLength(before + KINDS.length);
    expect(universe().things.map(({ id }) => id)).toEqual(
      expect.arrayContaining(['wall', 'box', 'cylinder', 'sphere', 'crate_2', 'ball_2', 'floor', 'person']),
    );
    expect(screen.getByRole('button', { name: 'Place: Person who walks' })).toBe(
      screen.getByTestId('place-person'),
    );
  });

  it('shows the ghost of what is chosen where there is a view in 3D', async () => {
    const { editor, universe } = palette({ 'models/b.sdf': '' });
    const before = universe().things.length;
    const placer = { aim: () => true, shift: vi.fn(), put: vi.fn(), focus: vi.fn() };
    act(() => showIn(editor, { center: () => [0, 0], forward: () => [1, 0], cancel: () => false }, placer));
    await user.click(screen.getByTestId('place-wall'));
    expect(editor.store.getState().placing).toEqual({ name: 'Wall', what: { kind: 'wall' } });
    await user.click(screen.getByTestId('place-file'));
    await user.click(await screen.findByRole('menuitem', { name: 'models/b.sdf' }));
    expect(editor.store.getState().placing?.what).toEqual({
      kind: 'file',
      shape: 'sdf',
      file: 'models/b.sdf',
    });
    expect(universe().things).toHaveLength(before);
  });

  it('offers robots of the project first, each id once', async () => {
    const { thing } = palette({ 'robots/mine/robot.yaml': '' });
    await user.click(screen.getByTestId('place-robot'));
    await screen.findByRole('menuitem', { name: 'Turtle' });
    expect(screen.getAllByRole('menuitem').map(({ textContent }) => textContent)).toEqual(['mine', 'Turtle']);
    await user.click(screen.getByRole('menuitem', { name: 'mine' }));
    expect(thing('robot_2')).toMatchObject({ model: 'mine' });
  });

  it('offers the meshes and models of the project in order, without those of robots', async () => {
    const { thing } = palette({
      'robots/mine/meshes/base.stl': '',
      'models/b.sdf': '',
      'assets/a.glb': '',
      'models/arm.xacro': '',
      'notes.md': '',
    });
    await user.click(screen.getByTestId('place-file'));
    expect(await screen.findByText('Of this project')).toBeInTheDocument();
    const items = screen.getAllByRole('menuitem').map(({ textContent }) => textContent);
    expect(items).toEqual([
      'assets/a.glb',
      'models/arm.xacro',
      'models/b.sdf',
      'Bring a mesh… (STL, OBJ, DAE, PLY, GLB)',
    ]);
    await user.click(screen.getByRole('menuitem', { name: 'models/b.sdf' }));
    expect(thing('b')).toMatchObject({ shape: 'sdf', file: 'models/b.sdf' });
  });

  it('shows that there is no mesh yet', async () => {
    palette();
    await user.click(screen.getByTestId('place-file'));
    expect(await screen.findByText('This project has no meshes yet')).toBeInTheDocument();
  });

  it('refuses a mesh that cannot be read, with the reason', async () => {
    const { universe, server } = palette();
    await user.upload(screen.getByTestId('mesh-file'), new File([EMPTY_STL], 'empty.stl'));
    expect(await screen.findByText(/empty\.stl cannot be used: it has no triangles/)).toBeInTheDocument();
    expect(universe().things).toHaveLength(5);
    expect(server.requests.filter(({ method }) => method === 'POST')).toEqual([]);
  });

  it("asks for a file with the page's own dialogue", async () => {
    palette();
    const input = screen.getByTestId<HTMLInputElement>('mesh-file');
    expect(input.accept).toBe('.stl,.obj,.dae,.ply,.glb');
    const choose = vi.spyOn(input, 'click').mockImplementation(() => undefined);
    await user.click(screen.getByTestId('place-file'));
    await user.click(await screen.findByRole('menuitem', { name: /Bring a mesh/ }));
    expect(choose).toHaveBeenCalledOnce();
  });

  it('uploads a mesh, and places it', async () => {
    const { thing } = palette();
    const { requests } = fakeServer(takesFile('assets/chair.stl'));
    await user.upload(screen.getByTestId('mesh-file'), new File([stl(1)], 'chair.stl'));
    await waitFor(() => expect(thing('chair')).toMatchObject({ shape: 'mesh', file: 'assets/chair.stl' }));
    expect(requests.find(({ method }) => method === 'POST')?.body).toMatchObject({
      files: [{ path: 'assets/chair.stl', base_revision: 0, content_base64: btoa(stl(1)) }],
    });
  });
});

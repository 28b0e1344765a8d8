import { screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import type * as Module from '@/features/editor3d/scene/Picture3d';
import { useProjectStore } from '@/store/project';
import { projectDetail, projectFile } from '@/store/testing';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { UniversePicture } from './UniversePicture';

const gl = vi.hoisted(() => ({ isThere: false }));

vi.mock('@/features/editor3d/scene/Picture3d', async (original) => {
  const real = await original<typeof Module>();
  const Picture3d: typeof real.Picture3d = (props) =>
    gl.isThere ? <div role="img" aria-label={props.label} /> : <real.Picture3d {...props} />;
  return { ...real, Picture3d };
});

it('is not there without WebGL', () => {
  openProject({ texts: { 'universes/a.yaml': 'name: A\n' } });
  const { container } = show(<UniversePicture path="universes/a.yaml" />);
  expect(container.querySelector('canvas, [role=img]')).toBeNull();
});

it('shows a large universe when its text has arrived', async () => {
  gl.isThere = true;
  onTestFinished(() => {
    gl.isThere = false;
    useProjectStore.getState().close();
  });
  const path = 'universes/a.yaml';
  const text = 'format: bt-studio/universe\nversion: 1\nname: Yard\n';
  fakeServer({ [`GET /projects/p1/files/${path}`]: new Response(text) });
  const file = { ...projectFile(path, 1, ''), content: null, left_out: true };
  useProjectStore.getState().load(projectDetail(1, [file]));
  show(<UniversePicture path={path} />);
  expect(await screen.findByRole('img', { name: 'Yard' })).toBeInTheDocument();
});

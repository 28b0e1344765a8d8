import { screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import { useProjectStore } from '@/store/project';
import { projectDetail, projectFile } from '@/store/testing';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { RobotPicture } from './RobotPicture';

vi.mock('@/features/editor3d/scene/Picture3d', () => ({
  Picture3d: ({ label }: { label: string }) => <div role="img" aria-label={label} />,
  PictureStage: () => null,
}));

it('is not there where nothing can be shown', () => {
  openProject({ texts: { 'robots/a/robot.yaml': 'urdf: [' } });
  const { container } = show(<RobotPicture path="robots/a/robot.yaml" />);
  expect(container.querySelector('canvas, [role=img]')).toBeNull();
});

it('shows a robot with a large URDF when that has arrived', async () => {
  onTestFinished(() => useProjectStore.getState().close());
  fakeServer({ 'GET /projects/p1/files/robots/a/robot.urdf': new Response(robotUrdf) });
  const urdf = { ...projectFile('robots/a/robot.urdf', 1, ''), content: null, left_out: true };
  useProjectStore.getState().load(projectDetail(1, [projectFile('robots/a/robot.yaml', 1, robotYaml), urdf]));
  show(<RobotPicture path="robots/a/robot.yaml" />);
  expect(screen.queryByRole('img')).toBeNull();
  expect(await screen.findByRole('img', { name: 'My robot' })).toBeInTheDocument();
});

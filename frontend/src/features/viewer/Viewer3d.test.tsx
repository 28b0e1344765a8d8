import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import type { Scene } from '@/generated/messages';
import { atPresent, useMoment } from '@/store/moment/store';
import { useRunStore } from '@/store/run/store';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import { streams } from '@/store/session/streams';
import { pretendWebGl } from '../../../harness/scene';
import { openProject, show, user } from '../../../harness/testing';
import { Viewer3d } from './Viewer3d';
import type * as Picture from './WorldPicture';

type PictureProps = Parameters<typeof Picture.WorldPicture>[0];

const picture = vi.hoisted(() => ({ props: null as PictureProps | null }));

vi.mock('./WorldPicture', async (load) => {
  const { WorldPicture } = await load<typeof Picture>();
  return {
    WorldPicture: (props: PictureProps) => {
      picture.props = props;
      return <WorldPicture {...props} />;
    },
  };
});

pretendWebGl('NVIDIA');

const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [{ id: 1, body: 'wall', link: '', kind: 'static', shapes: [], pose: [0, 0, 0, 0, 0, 0, 1] }],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

const wanted = new Map<string, unknown>();

beforeEach(() => {
  localStorage.clear();
  wanted.clear();
  streams.connect((stream, options) => wanted.set(stream, options));
  onTestFinished(() => {
    streams.disconnect();
    frames.clear();
    useRunStore.setState(useRunStore.getInitialState(), true);
    useSessionStore.setState({ executor: 'idle', isLaunching: false });
  });
});

function viewer(texts: Record<string, string> = {}) {
  openProject({ texts });
  return show(<Viewer3d />);
}

const begin = () => {
  act(() => {
    useSessionStore.setState({ executor: 'visualization_ready' });
    frames.publish(SCENE);
  });
};

describe('the 3D view without a world', () => {
  it('explains how to start one, and starts it', async () => {
    const run = vi.fn();
    onTestFinished(registerCommands([{ id: 'run.run', group: 'run', labelKey: '', run }]));
    viewer();
    expect(screen.getByText('Press Run to start the world.')).toBeInTheDocument();
    expect(screen.getByTestId('viewer-3d')).toHaveAttribute('data-objects', '0');
    await user.click(screen.getByRole('button', { name: 'Run' }));
    expect(run).toHaveBeenCalledOnce();
  });

  it('shows that it waits for the world', () => {
    viewer();
    act(() => useSessionStore.setState({ isLaunching: true }));
    expect(screen.getByText('Waiting for the world…')).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'Run' })).toBeNull();
    act(() => useSessionStore.setState({ isLaunching: false, executor: 'universe_ready' }));
    expect(screen.getByText('Waiting for the world…')).toBeInTheDocument();
    act(() => useSessionStore.setState({ executor: 'held', held: null }));
    expect(screen.getByText(/^Held in Python/)).toBeInTheDocument();
    act(() => useSessionStore.setState({ executor: 'connected' }));
    expect(screen.getByText('Press Run to start the world.')).toBeInTheDocument();
  });

  it('reports why nothing can run', () => {
    viewer();
    act(() => useRunStore.setState({ runBlocker: 'viewer' as never }));
    expect(screen.queryByText('Press Run to start the world.')).toBeNull();
    expect(screen.queryByRole('button', { name: 'Run' })).toBeNull();
  });
});

describe('the 3D view of a world', () => {
  it('is shown with its tools, until it is stopped', () => {
    viewer();
    begin();
    expect(screen.getByTestId('viewer-3d')).toHaveAttribute('data-objects', '1');
    expect(screen.getByRole('img', { name: 'The world in 3D' })).toBeInTheDocument();
    expect(screen.getByRole('toolbar', { name: 'Tools of the 3D view' })).toBeInTheDocument();
    expect(screen.queryByText('Press Run to start the world.')).toBeNull();
    act(() => useSessionStore.setState({ executor: 'connected' }));
    expect(screen.queryByRole('toolbar')).toBeNull();
  });

  it('starts with the existing world', () => {
    frames.publish(SCENE);
    useSessionStore.setState({ executor: 'paused' });
    viewer();
    expect(screen.getByTestId('viewer-3d')).toHaveAttribute('data-objects', '1');
  });

  it('subscribes to poses and, while rays are shown, to scans', async () => {
    viewer();
    begin();
    expect(wanted.get('poses')).toEqual({ max_hz: 30 });
    expect(wanted.get('scan')).toEqual({ max_hz: 10 });
    await user.click(screen.getByRole('button', { name: 'Show in the view' }));
    await user.click(await screen.findByRole('menuitemcheckbox', { name: 'LIDAR rays' }));
    expect(wanted.get('scan')).toBeNull();
    expect(JSON.parse(localStorage.getItem('bts.viewer') ?? '{}')).toMatchObject({ rays: false, grid: true });
  });

  it('shows the camera if the program uses pictures, or on demand', async () => {
    viewer({ 'actions/See.py': 'from sensor_msgs.msg import Image' });
    begin();
    expect(screen.getByTestId('camera-inset')).toBeInTheDocument();
    await user.click(screen.getByRole('button', { name: 'Show in the view' }));
    await user.click(await screen.findByRole('menuitemcheckbox', { name: "Robot's camera" }));
    expect(screen.queryByTestId('camera-inset')).toBeNull();
  });

  it('shows no camera if the program uses no pictures', () => {
    viewer();
    begin();
    expect(screen.queryByTestId('camera-inset')).toBeNull();
  });

  it('becomes video where it is too slow, but for a past moment, of which there is none', () => {
    viewer();
    begin();
    expect(picture.props?.view.isJudged).toBe(true);
    act(() => picture.props?.onSlow(2));
    expect(screen.getByTestId('video-instead')).toBeInTheDocument();
    onTestFinished(() => useMoment.setState(atPresent));
    act(() => useMoment.setState({ t: 1 }));
    expect(screen.getByTestId('viewer-3d')).toBeInTheDocument();
    expect(picture.props?.view.isJudged).toBe(false);
    act(() => useMoment.setState(atPresent));
    expect(screen.getByTestId('video-instead')).toBeInTheDocument();
  });
});

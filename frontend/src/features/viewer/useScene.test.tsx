import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import type { Scene } from '@/generated/messages';
import { ofSession, useSource } from '@/store/moment/source';
import { atPresent, useMoment } from '@/store/moment/store';
import { frames } from '@/store/session/frames';
import { useSessionStore } from '@/store/session/store';
import { show } from '../../../harness/testing';
import { useScene } from './useScene';

function Named() {
  return <p>{useScene()?.name ?? 'none'}</p>;
}

it('is the recorded one of a kept run, also without a world', () => {
  onTestFinished(() => {
    useSource.setState(ofSession);
    useMoment.setState(atPresent);
  });
  show(<Named />);
  act(() => {
    useSource.setState({ source: { ...ofSession.source } });
    useMoment.setState({ scene: { name: 'Yard' } as Scene });
  });
  expect(screen.getByText('Yard')).toBeInTheDocument();
});

it('is the last scene, as long as there is a world', () => {
  onTestFinished(() => {
    frames.clear();
    useSessionStore.setState({ executor: 'idle' });
  });
  show(<Named />);
  expect(screen.getByText('none')).toBeInTheDocument();
  act(() => {
    useSessionStore.setState({ executor: 'universe_ready' });
    frames.publish({ type: 'scene', name: 'Maze', t: 0, objects: [] } as unknown as Scene);
  });
  expect(screen.getByText('Maze')).toBeInTheDocument();
  act(() => useSessionStore.setState({ executor: 'connected' }));
  expect(screen.getByText('none')).toBeInTheDocument();
});

import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show } from '../../../../harness/testing';
import { findInUse, isOutside, useInUse } from './inUse';

const MAZE = { 'GET /catalog/universes/maze/text': new Response('robots:\n  - {model: burger}\n') };
const texts = { 'universes/hall.yaml': 'robots: [{model: mine}]', 'robots/mine/robot.yaml': 'name: Mine' };

function open(settings: { universe?: string; robot?: string }, answers = {}) {
  const server = fakeServer(answers);
  openProject({ texts });
  useProjectStore.getState().setSettings(settings);
  return server;
}

describe('what the project uses', () => {
  it('is a built-in universe, and the robot that it places', async () => {
    open({ universe: 'maze' }, MAZE);
    expect(await findInUse('universe')).toEqual({
      kind: 'universe',
      id: 'maze',
      path: null,
      isOfUniverse: false,
    });
    expect(await findInUse('robot')).toEqual({ kind: 'robot', id: 'burger', path: null, isOfUniverse: true });
  });

  it('is a universe and a robot of its own, without a question to the server', async () => {
    const { requests } = open({ universe: 'hall' });
    expect((await findInUse('universe'))?.path).toBe('universes/hall.yaml');
    expect(await findInUse('robot')).toMatchObject({ path: 'robots/mine/robot.yaml', isOfUniverse: true });
    expect(requests).toEqual([]);
  });

  it('is the robot that the project names', async () => {
    open({ universe: 'maze', robot: 'rover' });
    expect(await findInUse('robot')).toEqual({ kind: 'robot', id: 'rover', path: null, isOfUniverse: false });
  });

  it('is no robot without a simulated world', async () => {
    open({ universe: 'none', robot: 'rover' });
    expect(isOutside((await findInUse('universe'))!)).toBe(true);
    expect(await findInUse('robot')).toBeNull();
  });

  it('is shown as soon as it is known', async () => {
    open({ universe: 'maze' }, MAZE);
    const Page = () => (
      <p>
        {useInUse()
          .map(({ id }) => id)
          .join(' and ')}
      </p>
    );
    show(<Page />);
    expect(screen.getByText('maze')).toBeInTheDocument();
    expect(await screen.findByText('maze and burger')).toBeInTheDocument();
  });
});

import { expect, it, vi } from 'vitest';
import { translates } from '@/i18n';
import { useUniverseChooser } from '@/store/dialogs/universeChooser';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, watchNavigation } from '../../../../harness/testing';
import { usedCommands } from './commands';

const command = (id: string) => usedCommands.find((each) => each.id === id)!;

function open(universe: string) {
  fakeServer({ 'GET /catalog/universes/maze/text': new Response('name: Maze\n') });
  openProject({ texts: { 'project.json': '{}', 'universes/hall.yaml': 'name: Hall' } });
  useProjectStore.getState().setSettings({ universe });
  return watchNavigation();
}

it("opens what is the project's own", async () => {
  const { openFile } = open('hall');
  command('project.editUniverse').run();
  await vi.waitFor(() => expect(openFile).toHaveBeenCalledExactlyOnceWith('universes/hall.yaml', undefined));
});

it('copies what is built in', async () => {
  const { openFile } = open('maze');
  command('project.editUniverse').run();
  await vi.waitFor(() =>
    expect(openFile).toHaveBeenCalledExactlyOnceWith('universes/my_maze.yaml', undefined),
  );
});

it('chooses a robot', () => {
  command('project.chooseRobot').run();
  expect(useUniverseChooser.getState()).toEqual({ isOpen: true, first: 'robot' });
});

it('changes nothing for a viewer', () => {
  open('maze');
  expect(command('project.editRobot').enabled?.()).toBe(true);
  useProjectStore.setState({ role: 'viewer' });
  expect(command('project.editRobot').enabled?.()).toBe(false);
});

it('has words', () => {
  for (const { labelKey } of usedCommands) expect(translates(labelKey)).toBe(true);
});

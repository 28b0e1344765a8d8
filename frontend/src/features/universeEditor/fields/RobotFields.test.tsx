import { screen, waitFor } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { choose, HALL, lookOnly, openUniverse, showUniverse, write } from '../../../../harness/documents';
import { fakeServer } from '../../../../harness/testing';
import { RobotFields } from './RobotFields';

const ROBOTS = [
  { id: 'turtle2', name: 'Turtle', description: '' },
  { id: 'rover', name: 'Rover', description: '' },
];

function fields(text = HALL) {
  fakeServer({ 'GET /catalog/robots': ROBOTS });
  const editor = openUniverse(text, { 'robots/mine/robot.yaml': '' });
  const shown = showUniverse(editor, ({ things }) => {
    const thing = things.find(({ id }) => id === 'robot');
    return thing?.section === 'robots' ? <RobotFields editor={editor} thing={thing} /> : null;
  });
  return { editor, ...shown };
}

const model = () => screen.getByRole('combobox', { name: 'Robot' });

describe('the fields of a robot in a universe', () => {
  it('choose another robot: one of the project, or a built-in one', async () => {
    const { thing } = fields();
    await waitFor(() => expect(model()).toHaveValue('Turtle'), { timeout: 10_000 });
    await choose(model(), 'Rover');
    expect(thing('robot')).toMatchObject({ model: 'rover' });
    await choose(model(), 'mine');
    expect(thing('robot')).toMatchObject({ model: 'mine' });
  });

  it('show a missing robot by its id', async () => {
    fields(HALL.replace('turtle2', 'gone'));
    await waitFor(() => expect(model()).toHaveValue('gone'));
  });

  it('turn it about the upright axis only', async () => {
    const { thing } = fields();
    expect(screen.queryByTestId('field-roll')).toBeNull();
    expect(screen.queryByTestId('field-pitch')).toBeNull();
    await write('field-yaw', '-90');
    await write('field-x', '1');
    expect(thing('robot')).toMatchObject({ pose: [1, 3, 0, 0, 0, -1.5708] });
  });

  it('cannot be edited in a read-only project', () => {
    fakeServer({ 'GET /catalog/robots': ROBOTS });
    const editor = openUniverse();
    lookOnly();
    showUniverse(editor, ({ things }) =>
      things.map((thing) =>
        thing.section === 'robots' ? <RobotFields key={1} editor={editor} thing={thing} /> : null,
      ),
    );
    expect(model()).toBeDisabled();
  });
});

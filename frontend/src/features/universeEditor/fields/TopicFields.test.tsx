import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { HALL, openUniverse, showUniverse, type, write } from '../../../../harness/documents';
import { fakeServer, user } from '../../../../harness/testing';
import { TopicFields } from './TopicFields';

const CONFIG = `sensors:
  - {name: scan, kind: lidar, topic: /scan}
  - {name: camera, kind: camera, topic: /image}
`;

function fields(text = HALL, others: Readonly<Record<string, string>> = {}, answers = {}) {
  const server = fakeServer(answers);
  const editor = openUniverse(text, others);
  const shown = showUniverse(editor, ({ things }) => {
    const thing = things.find(({ id }) => id === 'robot');
    return thing?.section === 'robots' ? <TopicFields editor={editor} thing={thing} /> : null;
  });
  return { editor, server, ...shown };
}

const OWN = [HALL.replace('turtle2', 'mine'), { 'robots/mine/robot.yaml': CONFIG }] as const;

describe('the topics of a robot', () => {
  it("are those of a robot of the project, with the robot's labels", () => {
    const { server } = fields(...OWN);
    expect(screen.getByTestId('topic-of-scan')).toHaveValue('');
    expect(screen.getByTestId('topic-of-scan')).toHaveAttribute('placeholder', '/scan');
    expect(screen.getByTestId('topic-of-camera')).toHaveAttribute('placeholder', '/image');
    expect(server.requests).toEqual([]);
  });

  it('are requested for a built-in robot', async () => {
    fields(HALL, {}, { 'GET /catalog/robots/turtle2/config': new Response(CONFIG) });
    expect(screen.queryByText('Topic names in this world')).toBeNull();
    expect(await screen.findByTestId('topic-of-scan')).toBeInTheDocument();
    expect(screen.getByText('Topic names in this world')).toBeInTheDocument();
  });

  it('can be renamed here, one by one, and reset', async () => {
    const { thing, universe } = fields(...OWN);
    await write('topic-of-scan', '/front');
    await write('topic-of-camera', '/eye');
    expect(thing('robot')).toMatchObject({ topics: { scan: '/front', camera: '/eye' } });
    await write('topic-of-scan', '');
    expect(thing('robot')).toMatchObject({ topics: { camera: '/eye' } });
    await write('topic-of-camera', '/image');
    expect(JSON.stringify(universe().raw['robots'])).not.toContain('topics');
  });

  it('must be valid topics', async () => {
    const { thing } = fields(...OWN);
    await type('topic-of-scan', 'front');
    expect(screen.getByText(/A topic begins with \//)).toBeInTheDocument();
    await user.clear(screen.getByTestId('topic-of-scan'));
    expect(screen.queryByText(/A topic begins with \//)).toBeNull();
    await write('topic-of-scan', 'front');
    expect(thing('robot')).toMatchObject({ topics: {} });
  });
});

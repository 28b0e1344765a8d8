import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { openSession, show, user, type FakeExecutor } from '../../../harness/testing';
import { closePublish, openPublish, usePublishing } from './publishing';
import { PublishDialog } from './PublishDialog';

const TWIST = 'geometry_msgs/msg/Twist';
let executor: FakeExecutor;

beforeEach(async () => {
  executor = await openSession();
  executor.emit('topics', {
    topics: [
      {
        name: '/cmd_vel',
        type: TWIST,
        types: [TWIST],
        hz: null,
        bytes_per_s: null,
        publishers: [],
        subscribers: [],
      },
    ],
  });
  openPublish('', '');
  onTestFinished(closePublish);
  show(<PublishDialog />);
});

const message = () => screen.getByLabelText('Message');
const write = (text: string) => fireEvent.change(message(), { target: { value: text } });
const publish = () => user.click(screen.getByRole('button', { name: 'Publish once' }));

async function fill() {
  await user.click(screen.getByRole('combobox', { name: /Topic/ }));
  await user.paste('/cmd_vel');
  expect(screen.getByRole('combobox', { name: /Type/ })).toHaveValue(TWIST);
}

describe('PublishDialog', () => {
  it('takes the type from the topic, and its fields from the session', async () => {
    await fill();
    await expect.poll(() => executor.sentAs('describe_type')).toEqual([{ type: TWIST }]);
    executor.emit('type_description', {
      type: TWIST,
      fields: { linear: 'Vector3', angular: 'Vector3' },
      example: { linear: { x: 0 } },
    });
    expect(screen.getByText('linear: Vector3 · angular: Vector3')).toBeInTheDocument();
    expect(JSON.parse((message() as HTMLTextAreaElement).value)).toEqual({ linear: { x: 0 } });
  });

  it('publishes what was typed', async () => {
    await fill();
    write('{"linear": {"x": 0.5}}');
    await publish();
    expect(executor.sentAs('publish_topic')).toEqual([
      { topic: '/cmd_vel', type: TWIST, message: { linear: { x: 0.5 } } },
    ]);
    expect(screen.getByText('One message was published on /cmd_vel.')).toBeInTheDocument();
  });

  it.each(['[1]', 'null', '3'])('refuses %s, since it is no object', async (text) => {
    await fill();
    write(text);
    await publish();
    expect(screen.getByText(/has to be a JSON object/)).toBeInTheDocument();
    expect(executor.sentAs('publish_topic')).toEqual([]);
  });

  it('reports that a text is not JSON', async () => {
    await fill();
    write('{"x": ');
    fireEvent.blur(message());
    await publish();
    expect(screen.getByText('This is not JSON')).toBeInTheDocument();
    expect(executor.sentAs('publish_topic')).toEqual([]);
  });

  it('shows why the session refuses a message', async () => {
    executor.refuse('publish_topic', 'No field y.', 'Did you mean x?');
    await fill();
    write('{"y": 1}');
    await publish();
    expect(await screen.findByText('No field y. Did you mean x?')).toBeInTheDocument();
  });

  it('sends nothing with Enter, and with Ctrl+Enter only what is shown', async () => {
    const field = screen.getByRole('combobox', { name: /Topic/ });
    await user.type(field, '/cmd_vel{Enter}');
    await user.type(field, '{Control>}{Enter}{/Control}');
    expect(screen.getByRole('button', { name: 'Publish once' })).toBeDisabled();
    expect(executor.sentAs('publish_topic')).toEqual([]);
    await expect.poll(() => executor.sentAs('describe_type')).toEqual([{ type: TWIST }]);
    executor.emit('type_description', { type: TWIST, fields: {}, example: { linear: { x: 0 } } });
    await user.type(field, '{Enter}');
    expect(executor.sentAs('publish_topic')).toEqual([]);
    await user.type(field, '{Control>}{Enter}{/Control}');
    expect(executor.sentAs('publish_topic')).toHaveLength(1);
  });

  it('reports that the world is paused, and no success', async () => {
    executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
    expect(screen.getByTestId('paused-world')).toHaveTextContent('The world is paused.');
    executor.refuse('publish_topic', 'The world is paused.', '', 'world_paused');
    await fill();
    write('{"y": 1}');
    await publish();
    expect(screen.queryByText(/was published/)).toBeNull();
  });

  it('closes', async () => {
    await user.click(screen.getByText('Close'));
    expect(usePublishing.getState().opened).toBeNull();
  });
});

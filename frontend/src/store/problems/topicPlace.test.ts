import { expect, it } from 'vitest';
import type { LaunchNode, TopicMismatch } from '@/generated/messages';
import { placeOfTopic } from './topicPlace';

const mismatch: TopicMismatch = {
  topic: '/front/scan',
  publisher: '/world',
  subscriber: '/beeper',
  reason: 'qos',
  message: '',
  hint: '',
  code: 'qos',
  values: {},
  resolved: false,
};
const beeper: LaunchNode = {
  id: 'b',
  name: 'beeper',
  package: '',
  executable: '',
  file: 'launch/a.launch.yaml',
  line: 3,
  state: 'running',
  restarts: 0,
  end: '',
};
const launch = { 'launch/a.launch.yaml': { text: 'node: /front/scan' } };

it.each(['"/front/scan"', "'front/scan'"])('is the line of Python with %s', (name) => {
  const files = { ...launch, 'actions/Go.py': { text: `# front/scan\nx = "/scan"\nsub(Scan, ${name})` } };
  expect(placeOfTopic(mismatch, { files, launchNodes: [beeper] })).toEqual({
    file: 'actions/Go.py',
    line: 3,
  });
});

it('is else the launch node at one of the ends', () => {
  expect(placeOfTopic(mismatch, { files: launch, launchNodes: [beeper] })).toEqual({
    file: 'launch/a.launch.yaml',
    line: 3,
  });
});

it('is nowhere if both ends are out of the project', () => {
  const files = { 'actions/Go.py': { text: '"/front/scanner"' }, 'a.png': {} };
  expect(placeOfTopic(mismatch, { files, launchNodes: [beeper] })).toBeNull();
});

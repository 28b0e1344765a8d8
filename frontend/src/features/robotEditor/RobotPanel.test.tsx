import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { select } from '@/features/editor3d/editing';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import { useProjectStore } from '@/store/project';
import { type, write } from '../../../harness/documents';
import { openProject, show, user } from '../../../harness/testing';
import { editorOf, readingOf, type RobotEditor } from './editor';
import { RobotPanel } from './RobotPanel';

const PATH = 'robots/mine/robot.yaml';

let editor: RobotEditor;
let runs = 0;

/** The panel, with the current robot. */
function Panel() {
  useProjectStore((state) => state.files);
  const { robot } = readingOf(editor);
  return robot ? <RobotPanel editor={editor} robot={robot} /> : null;
}

const robot = () => readingOf(editor).robot!;

beforeEach(() => {
  openProject({ texts: { [PATH]: robotYaml, 'robots/mine/robot.urdf': robotUrdf } });
  // An editor outlives its tab but belongs to one project, so each test needs a new project.
  useProjectStore.setState({ projectId: `p${(runs += 1)}` });
  editor = editorOf(PATH);
  show(<Panel />);
});

describe('the fields of the whole robot', () => {
  it('name it', async () => {
    await write('robot-name', 'Rover');
    expect(robot().name).toBe('Rover');
    await type('robot-name', ' ');
    expect(screen.getByText('Must not be empty')).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(robot().name).toBe('Rover');
  });

  it('change the size of all wheels together, within their range', async () => {
    await write('wheel-radius', '0.05');
    expect(robot().wheelRadius).toBe(0.05);
    await write('wheel-track', '0.4');
    expect(robot().track).toBe(0.4);
    await write('wheel-radius', '50');
    expect(robot().wheelRadius).toBe(2);
  });

  it('choose its commands', async () => {
    await user.selectOptions(screen.getByTestId('command-type'), 'Twist');
    expect(robot().commandType).toBe('twist');
    const truth = screen.getByTestId('ground-truth');
    const before = robot().groundTruth;
    await user.click(truth);
    expect(robot().groundTruth).toBe(!before);
    await user.click(truth);
    expect(robot().groundTruth).toBe(before);
  });

  it('limit its speed, angles in degrees', async () => {
    await write('value-max_linear', '0.7');
    expect(robot().drive['max_linear']).toBe(0.7);
    await write('value-max_angular', '90');
    expect(robot().drive['max_angular']).toBeCloseTo(Math.PI / 2, 3);
  });
});

describe('the fields of a sensor', () => {
  beforeEach(() => {
    act(() => {
      select(editor, [robot().parts.find(({ kind }) => kind === 'lidar')!.key]);
    });
  });

  const lidar = () => robot().parts.find(({ kind }) => kind === 'lidar')!.sensor!.raw;

  it('change its topic, and refuse an invalid one', async () => {
    await write('value-topic', '/laser');
    expect(lidar()['topic']).toBe('/laser');
    await type('value-topic', 'no topic');
    expect(screen.getByText(/A topic begins with \//)).toBeInTheDocument();
    await user.keyboard('{Enter}');
    expect(lidar()['topic']).toBe('/laser');
  });

  it('accept whole numbers of rays', async () => {
    await write('value-rays', '90.4');
    expect(lidar()['rays']).toBe(90);
  });
});

describe('the fields of a part', () => {
  it('refuse a name that another part has', async () => {
    const links = robot().parts.filter(({ sensor }) => sensor === null);
    act(() => {
      select(editor, [links[0]!.key]);
    });
    await type('part-name', links[1]!.name);
    expect(screen.getByTestId('part-name')).toBeInvalid();
    await user.keyboard('{Enter}');
    expect(robot().parts.filter(({ name }) => name === links[1]!.name)).toHaveLength(1);
  });
});

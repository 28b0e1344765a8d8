import { number, text } from '../document/reading';
import type { Issue } from '../document/schema';
import { isObject, type Json, type JsonObject } from '../document/values';
import { parseXml, XmlError } from '../document/xml';
import { placed, remembering, valueOfYaml, type DocumentProblem } from '../document/yaml';
import { HERE } from '../document/frames';
import { checkConfig, checkNames } from './rules';
import {
  COMMAND_TYPES,
  SENSOR_KINDS,
  type Part,
  type PartKind,
  type Robot,
  type Sensor,
  type SensorKind,
} from './types';
import { poseOfLink, readUrdf, type Urdf, type UrdfIssue } from './urdf';

/** The result of reading both texts; `robot` is null if one of them cannot be shown. */
export interface RobotReading {
  readonly robot: Robot | null;
  readonly problems: readonly DocumentProblem[];
}

/** Returns the path of the URDF that a `robot.yaml` names, relative to that file; empty if it names none. */
export const urdfNameOf = remembering((yaml: string): string => {
  const said = valueOfYaml(yaml);
  return 'raw' in said && isObject(said.raw) ? text(said.raw['urdf'], '') : '';
});

interface UrdfReading {
  readonly urdf: Urdf | null;
  readonly issues: readonly UrdfIssue[];
}

const readXml = remembering((source: string): UrdfReading => {
  try {
    return readUrdf(parseXml(source));
  } catch (error) {
    if (!(error instanceof XmlError)) throw error;
    return {
      urdf: null,
      issues: [{ path: [], kind: error.kind, params: error.params, offset: error.offset }],
    };
  }
});

/** Returns the sensors and joints of a `robot.yaml` that have a topic, with their topics. */
export const topicsOf = remembering((yaml: string): readonly { name: string; topic: string }[] => {
  const said = valueOfYaml(yaml);
  if (!('raw' in said) || !isObject(said.raw)) return [];
  const joints = Array.isArray(said.raw['joints']) ? (said.raw['joints'] as Json[]) : [];
  return [
    ...sensorsOf(said.raw).map(({ name, raw }) => ({ name, topic: text(raw['topic'], '') })),
    ...joints.flatMap((each) =>
      isObject(each) ? [{ name: text(each['joint'], ''), topic: text(each['topic'], '') }] : [],
    ),
  ].filter(({ name, topic }) => name !== '' && topic !== '');
});

const KEY = '\0';
const readBoth = remembering((both: string): RobotReading => {
  const [yaml = '', urdf] = both.split(KEY);
  return read(yaml, urdf ?? null);
});

/** Reads a robot; equal texts give the same object (cached). `urdf` is null if the file does not exist. */
export const readRobot = (yaml: string, urdf: string | null): RobotReading =>
  readBoth(urdf === null ? yaml : `${yaml}${KEY}${urdf}`);

function read(yaml: string, urdfText: string | null): RobotReading {
  const said = valueOfYaml(yaml);
  const links = urdfText === null ? null : readXml(urdfText);
  const inUrdf = links && urdfText !== null ? urdfProblems(urdfText, links.issues) : [];
  if ('problems' in said) return { robot: null, problems: [...said.problems, ...inUrdf] };
  const robot =
    isObject(said.raw) && links?.urdf && urdfText !== null ? robotOf(said.raw, links.urdf, urdfText) : null;
  const missing: Issue[] =
    urdfText === null && isObject(said.raw) && typeof said.raw['urdf'] === 'string'
      ? [
          {
            path: ['urdf'],
            kind: /\.urdf$/i.test(said.raw['urdf']) ? 'noUrdf' : 'otherModel',
            params: { file: said.raw['urdf'] },
          },
        ]
      : [];
  const issues = [...checkConfig(said.raw), ...missing, ...(robot ? checkNames(robot.raw, robot.urdf) : [])];
  const thingAt = ([section, index]: Issue['path']) =>
    section === 'sensors' ? (robot?.parts.find(({ sensor }) => sensor?.index === index)?.key ?? null) : null;
  return { robot, problems: [...placed(yaml, issues, thingAt), ...inUrdf] };
}

function urdfProblems(source: string, issues: readonly UrdfIssue[]): DocumentProblem[] {
  return issues
    .map(({ offset, ...issue }) => {
      const before = source.slice(0, offset).split('\n');
      return {
        ...issue,
        text: 1,
        line: before.length,
        column: (before.at(-1) ?? '').length + 1,
        thing: null,
      };
    })
    .sort((a, b) => a.line - b.line || a.column - b.column);
}

const names = (value: Json | undefined): string[] =>
  Array.isArray(value) ? (value as Json[]).filter((each) => typeof each === 'string') : [];

function robotOf(raw: JsonObject, urdf: Urdf, urdfText: string): Robot {
  const drive = isObject(raw['drive']) ? raw['drive'] : {};
  const sensors = sensorsOf(raw);
  const left = names(drive['left']);
  const right = names(drive['right']);
  return {
    raw,
    name: text(raw['name'], ''),
    description: text(raw['description'], ''),
    drive,
    commandType: COMMAND_TYPES.find((kind) => kind === raw['command_type']) ?? 'both',
    groundTruth: raw['ground_truth'] === true,
    left,
    right,
    wheelRadius: number(drive['wheel_radius'], 0.05),
    track: number(drive['track'], 0.2),
    sensors,
    parts: partsOf(urdf, sensors, new Set([...left, ...right]), new Set(names(raw['wheels']))),
    urdf,
    urdfText,
  };
}

function sensorsOf(raw: JsonObject): Sensor[] {
  const list = Array.isArray(raw['sensors']) ? (raw['sensors'] as Json[]) : [];
  return list.flatMap((said, index): Sensor[] => {
    if (!isObject(said) || !(SENSOR_KINDS as readonly unknown[]).includes(said['kind'])) return [];
    const kind = said['kind'] as SensorKind;
    const link = kind === 'battery' ? null : text(said['link'], '');
    return [{ index, kind, name: text(said['name'], kind === 'lidar' ? 'scan' : kind), link, raw: said }];
  });
}

function partsOf(
  urdf: Urdf,
  sensors: readonly Sensor[],
  driven: ReadonlySet<string>,
  rolling: ReadonlySet<string>,
): Part[] {
  const sensed = new Set(sensors.map(({ link }) => link));
  const parts: Part[] = [];
  for (const { name } of urdf.links.values()) {
    const joint = urdf.above.get(name);
    if (joint && sensed.has(name)) continue;
    const kind: PartKind = !joint
      ? 'base'
      : driven.has(joint.name)
        ? 'wheel'
        : rolling.has(name)
          ? 'caster'
          : 'link';
    parts.push({
      key: `link ${name}`,
      kind,
      name,
      link: name,
      shows: name,
      sensor: null,
      pose: poseOfLink(urdf, name),
    });
  }
  const taken = new Set(parts.map(({ shows }) => shows));
  const keys = new Set<string>();
  for (const sensor of sensors) {
    const link = sensor.link !== null && urdf.links.has(sensor.link) ? sensor.link : null;
    let key = `sensor ${sensor.name}`;
    for (let count = 2; keys.has(key); count += 1) key = `sensor ${sensor.name}#${count}`;
    keys.add(key);
    parts.push({
      key,
      kind: sensor.kind,
      name: sensor.name,
      link,
      shows: link !== null && !taken.has(link) ? link : null,
      sensor,
      pose: link === null ? HERE : poseOfLink(urdf, link),
    });
    taken.add(link);
  }
  return parts;
}

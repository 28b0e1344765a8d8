import { xml } from '@codemirror/lang-xml';
import type { Extension } from '@codemirror/state';
import { shippedDoc } from '@/i18n/shipped';
import type { PortSpec } from '@/model/ports';
import type { NodeSpec, Vocabulary } from '@/model/vocabulary';

const CONDITIONS = [
  '_skipIf',
  '_successIf',
  '_failureIf',
  '_while',
  '_onSuccess',
  '_onFailure',
  '_post',
  '_onHalted',
];
const COMMON = ['name', '_description', ...CONDITIONS];

function valuesOf(port: PortSpec): string[] {
  if (port.type === 'bool') return ['true', 'false'];
  return port.default === null ? [] : [port.default];
}

function elementOf(spec: NodeSpec, trees: readonly string[]) {
  const ports = spec.ports.map((port) => ({ name: port.name, values: valuesOf(port) }));
  const target = spec.type === 'SubTree' ? [{ name: 'ID', values: trees }] : [];
  return {
    name: spec.type,
    attributes: [...target, ...ports, ...COMMON],
    completion: { detail: shippedDoc(spec.type, spec.summary).split('\n')[0] ?? '' },
    ...(spec.maxChildren === 0 ? { children: [] } : {}),
  };
}

/** Returns the extensions for XML with completion of the project's nodes, ports and trees. */
export function treeXml(vocabulary: Vocabulary): Extension {
  const trees = [...vocabulary.trees.keys()];
  const specs = [...vocabulary.specs.values()];
  const elements = [
    { name: 'root', top: true, children: ['BehaviorTree'], attributes: ['BTCPP_format'] },
    { name: 'BehaviorTree', attributes: ['ID'] },
    ...specs.map((spec) => elementOf(spec, trees)),
  ];
  return xml({ elements, attributes: COMMON.map((name) => ({ name })) });
}

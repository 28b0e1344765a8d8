import { displayName, type DiagramNode } from './diagram';
import { directionOf, shortLabel } from './rosFields';
import type { NodeSpec } from './vocabulary';

/**
 * Computes the sizes of blocks from their content, so that the layout needs no browser. The canvas draws
 * blocks with the same numbers (features/canvas/block.css).
 */
export const BLOCK = {
  minWidth: 132,
  maxWidth: 300,
  header: 44,
  tile: 44,
  portRow: 22,
  portsPadding: 8,
  maxPorts: 6,
  valueLetters: 16,
} as const;

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** A line of a block's ports. */
export interface PortLine {
  readonly name: string;
  /** The name as the block shows it. */
  readonly label: string;
  /** null: the value is not set, so the default applies. */
  readonly value: string | null;
  readonly default: string | null;
  readonly required: boolean;
  readonly direction: 'input' | 'output' | 'inout';
}

/**
 * Returns the declared ports in their order, then the other ports that are set. A ROS block shows what is set,
 * since its settings would hide its fields.
 */
export function portLines(node: DiagramNode, spec: NodeSpec | undefined): PortLine[] {
  const declared = (spec?.ports ?? []).map((port) => ({
    name: port.name,
    label: port.name,
    value: node.ports?.[port.name] ?? null,
    default: port.default,
    required: port.required,
    direction: port.direction,
  }));
  const known = new Set(declared.map((line) => line.name));
  const extra = Object.entries(node.ports ?? {})
    .filter(([name]) => !known.has(name))
    .map(([name, value]) => ({
      name,
      label: spec?.group === 'ros' ? shortLabel(name) : name,
      value,
      default: null,
      required: false,
      direction: spec?.group === 'ros' ? directionOf(node.type, name) : ('input' as const),
    }));
  const shown =
    spec?.group === 'ros' ? declared.filter((line) => line.required || line.value !== null) : declared;
  return [...shown, ...extra];
}

const NARROW = /[iljtfrI.,:;'|()[\]{} ]/;
const WIDE = /[mwMW@%]/;

/** Returns the approximate width of a text in em, from Inter's narrow, wide, capital and other letters. */
export function emWidth(text: string): number {
  let width = 0;
  for (const letter of text) {
    if (NARROW.test(letter)) width += 0.33;
    else if (WIDE.test(letter)) width += 0.9;
    else if (letter.charCodeAt(0) > 0x2e80) width += 1.05;
    else if (letter !== letter.toLowerCase()) width += 0.7;
    else width += 0.59;
  }
  return width;
}

/** Returns the width of a port's value; longer values are cut to `valueLetters` characters. */
function valueWidth(line: PortLine): number {
  const text = line.value ?? line.default ?? (line.required ? 'required' : '—');
  return Math.min(BLOCK.valueLetters, text.length) * 7;
}

const known = new WeakMap<DiagramNode, { readonly spec: NodeSpec | undefined; readonly size: Size }>();

/** Measures a node; the result is cached, since a node and its spec never change. */
export function measureNode(node: DiagramNode, spec: NodeSpec | undefined): Size {
  const last = known.get(node);
  if (last && last.spec === spec) return last.size;
  const size = measured(node, spec);
  known.set(node, { spec, size });
  return size;
}

function measured(node: DiagramNode, spec: NodeSpec | undefined): Size {
  const lines = portLines(node, spec);
  const name = emWidth(displayName(node)) * 14;
  const type = emWidth(node.type) * 11.5;
  const badges = (node.comment ? 18 : 0) + (node.conditions ? 18 : 0);
  const title = BLOCK.tile + Math.max(name, type + badges) + 30;
  const ports = lines
    .slice(0, BLOCK.maxPorts)
    .map((line) => emWidth(line.label) * 12 + (line.direction === 'input' ? 0 : 18) + valueWidth(line) + 100);
  const width = Math.max(BLOCK.minWidth, Math.min(BLOCK.maxWidth, Math.max(title, ...ports)));
  const rows = Math.min(lines.length, BLOCK.maxPorts) + (lines.length > BLOCK.maxPorts ? 1 : 0);
  const height = BLOCK.header + (rows > 0 ? rows * BLOCK.portRow + BLOCK.portsPadding : 0);
  // Even sizes keep centred edges on whole pixels.
  return { width: 2 * Math.ceil(width / 2), height };
}

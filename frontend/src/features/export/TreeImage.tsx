import type { ReactNode } from 'react';
import { displayName, type Diagram, type DiagramNode } from '@/model/diagram';
import { visibleChildren, type Box, type Layout } from '@/model/layout';
import { BLOCK, emWidth, portLines } from '@/model/measure';
import { specOf, type NodeSpec, type Vocabulary } from '@/model/vocabulary';
import { NodeSymbol } from '@/ui/NodeSymbol';
import { elbow, outline } from '@/ui/shapes';
import type { Palette } from './palette';

export interface TreeImageProps {
  readonly diagram: Diagram;
  readonly layout: Layout;
  readonly vocabulary: Vocabulary;
  readonly palette: Palette;
  /** Elements that are drawn over the blocks. */
  readonly children?: ReactNode;
}

const MARGIN = 24;
const SANS = "Inter, 'Inter Variable', system-ui, 'Segoe UI', sans-serif";
const MONO = "'JetBrains Mono', ui-monospace, Menlo, monospace";

/** Shortens a text to a width in px at a font size. */
function cut(text: string, width: number, size: number): string {
  if (emWidth(text) * size <= width) return text;
  let kept = text;
  while (kept.length > 1 && emWidth(`${kept}…`) * size > width) kept = kept.slice(0, -1);
  return `${kept}…`;
}

function edgeOf(from: Box, to: Box, isHorizontal: boolean): string {
  return isHorizontal
    ? elbow(from.x + from.width, from.y + from.height / 2, to.x, to.y + to.height / 2, true)
    : elbow(from.x + from.width / 2, from.y + from.height, to.x + to.width / 2, to.y, false);
}

interface BlockImageProps {
  readonly id: string;
  readonly node: DiagramNode;
  readonly box: Box;
  readonly spec: NodeSpec | undefined;
  readonly palette: Palette;
}

function BlockImage({ id, node, box, spec, palette }: BlockImageProps) {
  const family = spec?.family ?? null;
  const path = outline(family, box.width, box.height);
  const name = displayName(node);
  const hasType = name !== node.type && node.type !== 'SubTree';
  const room = box.width - BLOCK.tile - 20;
  const ports = portLines(node, spec).slice(0, BLOCK.maxPorts);
  return (
    <g transform={`translate(${box.x} ${box.y})`} opacity={node.disabled ? 0.45 : 1}>
      <clipPath id={`clip-${id}`}>
        <path d={path} />
      </clipPath>
      <path d={path} fill={palette('surface')} />
      <rect
        width={BLOCK.tile}
        height={box.height}
        clipPath={`url(#clip-${id})`}
        fill={node.color ?? palette(family ?? 'unknown')}
      />
      <path d={path} fill="none" stroke={palette(family ?? 'unknown')} strokeWidth={1.5} />
      <g transform="translate(12 12)" color={palette('on-family')}>
        <NodeSymbol type={node.type} family={family} size={20} />
      </g>
      <text x={BLOCK.tile + 10} y={hasType ? 20 : 27} fontSize={14} fontWeight={600} fill={palette('text')}>
        {cut(name, room, 14)}
      </text>
      {hasType ? (
        <text x={BLOCK.tile + 10} y={35} fontSize={11.5} fill={palette('muted')}>
          {cut(node.type, room, 11.5)}
        </text>
      ) : null}
      {ports.map((port, row) => {
        const y = BLOCK.header + row * BLOCK.portRow + 13;
        const value = port.value ?? port.default ?? '—';
        return (
          <g key={port.name}>
            <text x={BLOCK.tile + 10} y={y} fontSize={12} fill={palette('muted')}>
              {cut(port.label, room * 0.6, 12)}
            </text>
            <text
              x={box.width - 12}
              y={y}
              fontSize={11.5}
              fontFamily={MONO}
              textAnchor="end"
              fill={palette(port.value === null ? 'muted' : 'text')}
            >
              {value.length > 16 ? `${value.slice(0, 15)}…` : value}
            </text>
          </g>
        );
      })}
    </g>
  );
}

/** The whole tree as a self-contained picture, for papers, slides and issues. */
export function TreeImage({ diagram, layout, vocabulary, palette, children }: TreeImageProps) {
  const boxes = Object.entries(layout.positions);
  const left = Math.min(0, ...boxes.map(([, box]) => box.x)) - MARGIN;
  const top = Math.min(0, ...boxes.map(([, box]) => box.y)) - MARGIN;
  const width = Math.max(0, ...boxes.map(([, box]) => box.x + box.width)) + MARGIN - left;
  const height = Math.max(0, ...boxes.map(([, box]) => box.y + box.height)) + MARGIN - top;
  const isHorizontal = diagram.layout === 'horizontal';
  return (
    <svg width={width} height={height} viewBox={`${left} ${top} ${width} ${height}`} fontFamily={SANS}>
      <title>{diagram.id}</title>
      <rect x={left} y={top} width={width} height={height} fill={palette('canvas')} />
      {boxes.flatMap(([id, box]) =>
        visibleChildren(diagram, id).map((child) => {
          const to = layout.positions[child];
          return to ? (
            <path
              key={`${id}-${child}`}
              d={edgeOf(box, to, isHorizontal)}
              fill="none"
              stroke={palette('edge')}
              strokeWidth={2}
            />
          ) : null;
        }),
      )}
      {boxes.map(([id, box]) => {
        const node = diagram.nodes[id];
        return node ? (
          <BlockImage
            key={id}
            id={id}
            node={node}
            box={box}
            spec={specOf(vocabulary, node)}
            palette={palette}
          />
        ) : null;
      })}
      {children}
    </svg>
  );
}

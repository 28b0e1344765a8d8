import type { TFunction } from 'i18next';
import { useShallow } from 'zustand/react/shallow';
import type { DiagramNode } from '@/model/diagram';
import type { Inside } from '@/model/expand';
import { keyIn } from '@/model/keys/entry';
import { BLOCK, portLines, type PortLine } from '@/model/measure';
import { readPortText } from '@/model/ports';
import type { NodeSpec } from '@/model/vocabulary';
import { shownPort, useShownValues, type ShownPort } from '@/store/session/values/shown';
import { PortValue } from './PortValue';
import type { PortMark, PortMarks } from '@/store/run/portMarks';
import classes from './Block.module.css';

function valueClass(line: PortLine): string {
  if (line.value === null) return line.required && line.default === null ? 'portMissing' : 'portDefault';
  const kind = readPortText(line.value).kind;
  if (kind === 'broken') return 'portMissing';
  return kind === 'key' || kind === 'same-name' ? 'portKey' : 'portLiteral';
}

const ARROWS = { input: '', output: '→', inout: '⇄' } as const;

const shownValue = (line: PortLine, t: TFunction<'canvas'>): string =>
  line.value ?? line.default ?? (line.required ? t('port.missing') : '—');

const NONE: readonly string[] = [];

/** Returns the ports whose live values the user wants to see; a port with a fixed value has none. */
const wantedOf = (lines: readonly PortLine[], place: Inside, ports: ReadonlySet<ShownPort>): string[] =>
  lines
    .filter(({ name }) => ports.has(shownPort(place.tree, place.node, name)))
    .filter(({ name, value, default: text }) => keyIn(value ?? text ?? '', name) !== null)
    .map(({ name }) => name);

/**
 * Returns as many lines as fit, in their order; lines whose live values the user wants to see take
 * precedence.
 */
function fitting(lines: readonly PortLine[], wanted: ReadonlySet<string>): readonly PortLine[] {
  if (lines.length <= BLOCK.maxPorts) return lines;
  const first = [
    ...lines.filter(({ name }) => wanted.has(name)),
    ...lines.filter(({ name }) => !wanted.has(name)),
  ].slice(0, BLOCK.maxPorts);
  return lines.filter((line) => first.includes(line));
}

interface BlockPortsProps {
  /** The block's own tree and id. */
  readonly place: Inside;
  readonly node: DiagramNode;
  readonly spec: NodeSpec | undefined;
  readonly marks: PortMarks;
  readonly t: TFunction<'canvas'>;
}

/** Returns the tooltip of a value: the whole text, and the one before it. */
function titleOf(line: PortLine, mark: PortMark | undefined, t: TFunction<'canvas'>): string | undefined {
  if (!mark) return line.value ?? undefined;
  const before = mark.saved ?? line.default ?? t('port.noValue');
  return t(`port.live.${mark.state}`, { value: line.value ?? line.default ?? '', before });
}

/** The ports of a block with their values, as many as fit. */
export function BlockPorts({ place, node, spec, marks, t }: BlockPortsProps) {
  const lines = portLines(node, spec);
  const wanted = new Set(
    useShownValues(useShallow(({ ports }) => (ports.size === 0 ? NONE : wantedOf(lines, place, ports)))),
  );
  if (lines.length === 0) return null;
  const more = lines.length - BLOCK.maxPorts;
  return (
    <ul className={classes['ports']}>
      {fitting(lines, wanted).map((line) => {
        const value = shownValue(line, t);
        const mark = marks.get(line.name);
        return (
          <li key={line.name} className={classes['port']}>
            <span className={classes['portName']}>
              {ARROWS[line.direction]} {line.label}
            </span>
            {wanted.has(line.name) ? (
              <PortValue port={shownPort(place.tree, place.node, line.name)} text={value} />
            ) : (
              <span
                className={classes[valueClass(line)]}
                title={titleOf(line, mark, t)}
                data-live={mark?.state}
                data-long={value.length > BLOCK.valueLetters || undefined}
              >
                {value}
              </span>
            )}
          </li>
        );
      })}
      {more > 0 && <li className={classes['portMore']}>{t('port.more', { count: more })}</li>}
    </ul>
  );
}

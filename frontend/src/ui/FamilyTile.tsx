import type { Family } from '@/model/vocabulary';
import { NodeSymbol } from './NodeSymbol';
import { outline } from './shapes';

interface FamilyTileProps {
  readonly type: string;
  readonly family: Family | null;
  readonly size?: number;
}

/** A small picture of a node type: the shape and colour of its family, with its symbol. */
export function FamilyTile({ type, family, size = 24 }: FamilyTileProps) {
  return (
    <span
      style={{
        position: 'relative',
        display: 'inline-grid',
        placeItems: 'center',
        width: size,
        height: size,
        flex: 'none',
        color: 'var(--bts-on-family)',
      }}
      aria-hidden="true"
    >
      <svg width={size} height={size} viewBox="0 0 44 44" style={{ position: 'absolute', inset: 0 }}>
        <path d={outline(family, 44, 44, 0)} fill={`var(--bts-${family ?? 'unknown'})`} />
      </svg>
      <span style={{ position: 'relative', display: 'grid' }}>
        <NodeSymbol type={type} family={family} size={Math.round(size * 0.58)} />
      </span>
    </span>
  );
}

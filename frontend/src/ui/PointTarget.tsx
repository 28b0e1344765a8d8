import { Menu } from '@mantine/core';

interface PointTargetProps {
  readonly x: number;
  readonly y: number;
  /** The name of the menu. */
  readonly label: string;
}

/** Opens a menu at a point of the window, where the pointer is. */
export function PointTarget({ x, y, label }: PointTargetProps) {
  return (
    <Menu.Target>
      {/* Hidden: a point has no role that could say what it opens. */}
      <span
        aria-hidden="true"
        aria-label={label}
        style={{ position: 'fixed', left: x, top: y, width: 1, height: 1 }}
      />
    </Menu.Target>
  );
}

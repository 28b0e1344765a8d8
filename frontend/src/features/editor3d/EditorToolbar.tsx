import { ActionIcon, Button, Divider, SegmentedControl, Select, Tooltip } from '@mantine/core';
import {
  IconArrowsMove,
  IconCode,
  IconFocusCentered,
  IconGridDots,
  IconLayoutBoard,
  IconPlayerPlayFilled,
  IconRotate,
  IconRulerMeasure,
  IconView360Arrow,
} from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { useCommandTable } from '@/commands/registry';
import { useRunStore } from '@/store/run/store';
import classes from './editor3d.module.css';
import type { Editor, Mode } from './editing';

const MODE_ICONS: Readonly<Record<Mode, readonly [typeof IconArrowsMove, string]>> = {
  move: [IconArrowsMove, 'M'],
  turn: [IconRotate, 'R'],
  size: [IconRulerMeasure, 'S'],
};

interface EditorToolbarProps {
  readonly editor: Editor;
  readonly label: string;
  readonly modes: readonly Mode[];
  readonly grids: readonly number[];
  /** The label of the button that shows the text. */
  readonly textLabel: string;
  readonly textTestId: string;
  readonly onRun: () => void;
  /** The tools that only this editor has. */
  readonly children?: ReactNode;
}

const gridLabel = (step: number): string => (step < 0.05 ? `${step * 1000} mm` : `${step} m`);

/**
 * The toolbar of a 3D editor: tools, grid, views, the text, and the button that runs a robot in this
 * document.
 */
export function EditorToolbar(props: EditorToolbarProps) {
  const { editor, label, modes, grids, textLabel, textTestId, onRun, children } = props;
  const { t } = useTranslation('editor3d');
  const { mode, tool, grid, isTextShown } = useStore(editor.store);
  const isBlocked = useRunStore((state) => state.runBlocker !== null);
  const canRun = useCommandTable(({ commands }) => commands['run.run'] !== undefined) && !isBlocked;
  const { setState } = editor.store;
  return (
    <div className={classes['toolbar']} role="toolbar" aria-label={label}>
      <SegmentedControl
        size="xs"
        value={tool === 'wall' ? '' : mode}
        aria-label={t('mode.label')}
        onChange={(value) => setState({ mode: value as Mode, tool: 'select' })}
        data={modes.map((value) => {
          const [Icon, key] = MODE_ICONS[value];
          return {
            value,
            label: (
              <Tooltip label={`${t(`mode.${value}`)} (${key})`}>
                <span className={classes['mode']}>
                  <Icon size={16} aria-label={t(`mode.${value}`)} />
                </span>
              </Tooltip>
            ),
          };
        })}
      />
      {children}
      <Select
        size="xs"
        w={104}
        aria-label={t('grid')}
        leftSection={<IconGridDots size={15} />}
        allowDeselect={false}
        checkIconPosition="right"
        value={String(grid)}
        onChange={(value) => setState({ grid: Number(value) })}
        data={grids.map((step) => ({
          value: String(step),
          label: step === 0 ? t('gridOff') : gridLabel(step),
        }))}
      />
      <Divider orientation="vertical" my={4} />
      <Tool label={`${t('topView')} (T)`} onClick={() => setState({ viewpoint: { kind: 'top' } })}>
        <IconLayoutBoard size={18} />
      </Tool>
      <Tool label={`${t('perspective')} (P)`} onClick={() => setState({ viewpoint: { kind: 'default' } })}>
        <IconView360Arrow size={18} />
      </Tool>
      <Tool label={`${t('focus')} (F)`} onClick={() => setState({ viewpoint: { kind: 'selection' } })}>
        <IconFocusCentered size={18} />
      </Tool>
      <span className={classes['space']} />
      <Tool
        label={textLabel}
        isPressed={isTextShown}
        testId={textTestId}
        onClick={() => setState({ isTextShown: !isTextShown })}
      >
        <IconCode size={18} />
      </Tool>
      <Button
        size="xs"
        leftSection={<IconPlayerPlayFilled size={14} />}
        disabled={!canRun}
        data-testid="run-here"
        onClick={onRun}
      >
        {t('runHere')}
      </Button>
    </div>
  );
}

interface ToolProps {
  readonly label: string;
  readonly isPressed?: boolean;
  readonly testId?: string;
  readonly onClick: () => void;
  readonly children: ReactNode;
}

export function Tool({ label, isPressed, testId, onClick, children }: ToolProps) {
  return (
    <Tooltip label={label}>
      <ActionIcon
        size="md"
        variant={isPressed ? 'light' : 'subtle'}
        color={isPressed ? 'indigo' : 'gray'}
        aria-label={label}
        {...(isPressed === undefined ? {} : { 'aria-pressed': isPressed })}
        {...(testId ? { 'data-testid': testId } : {})}
        onClick={onClick}
      >
        {children}
      </ActionIcon>
    </Tooltip>
  );
}

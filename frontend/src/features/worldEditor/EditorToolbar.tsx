import { ActionIcon, Button, Divider, SegmentedControl, Select, Tooltip } from '@mantine/core';
import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconArrowsMove,
  IconCode,
  IconFocusCentered,
  IconGridDots,
  IconLayoutBoard,
  IconPlayerPlayFilled,
  IconRotate,
  IconRulerMeasure,
  IconView360Arrow,
  IconWall,
} from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { useStore } from 'zustand';
import { perform, useActionTable } from '@/actions/registry';
import { useProjectStore } from '@/store/project';
import { useWorldChoice } from '@/store/run/world';
import { GRIDS, travel, type Mode, type UniverseEditor } from './editor';
import classes from './worldEditor.module.css';

const MODE_ICONS: readonly (readonly [Mode, typeof IconArrowsMove, string])[] = [
  ['move', IconArrowsMove, 'M'],
  ['turn', IconRotate, 'R'],
  ['size', IconRulerMeasure, 'S'],
];

/** Tools, grid, views, steps back, the text, and the way to a robot that drives here. */
export function EditorToolbar({ editor }: { readonly editor: UniverseEditor }) {
  const { t } = useTranslation('worldEditor');
  const { mode, tool, grid, history, isTextShown } = useStore(editor.store);
  const canRun = useActionTable(({ actions }) => actions['run.run'] !== undefined);
  const { setState } = editor.store;

  const runHere = () => {
    const universe = editor.path.replace(/^universes\/|\.yaml$/g, '');
    const { settings } = useProjectStore.getState();
    useWorldChoice.setState({ universe: settings?.universe === universe ? null : universe });
    perform('run.run');
  };

  return (
    <div className={classes['toolbar']} role="toolbar" aria-label={t('tools')}>
      <SegmentedControl
        size="xs"
        value={tool === 'wall' ? '' : mode}
        aria-label={t('mode.label')}
        onChange={(value) => setState({ mode: value as Mode, tool: 'select' })}
        data={MODE_ICONS.map(([value, Icon, key]) => ({
          value,
          label: (
            <Tooltip label={`${t(`mode.${value}`)} (${key})`}>
              <span className={classes['mode']}>
                <Icon size={16} aria-label={t(`mode.${value}`)} />
              </span>
            </Tooltip>
          ),
        }))}
      />
      <Tool
        label={`${t('drawWalls')} (W)`}
        isPressed={tool === 'wall'}
        testId="draw-walls"
        onClick={() => setState({ tool: tool === 'wall' ? 'select' : 'wall' })}
      >
        <IconWall size={18} />
      </Tool>
      <Select
        size="xs"
        w={104}
        aria-label={t('grid')}
        leftSection={<IconGridDots size={15} />}
        allowDeselect={false}
        checkIconPosition="right"
        value={String(grid)}
        onChange={(value) => setState({ grid: Number(value) })}
        data={GRIDS.map((step) => ({ value: String(step), label: step === 0 ? t('gridOff') : `${step} m` }))}
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
      <Divider orientation="vertical" my={4} />
      <Tool
        label={t('undo')}
        isDisabled={history.past.length === 0}
        testId="universe-undo"
        onClick={() => travel(editor, 'undo')}
      >
        <IconArrowBackUp size={18} />
      </Tool>
      <Tool label={t('redo')} isDisabled={history.future.length === 0} onClick={() => travel(editor, 'redo')}>
        <IconArrowForwardUp size={18} />
      </Tool>
      <span className={classes['space']} />
      <Tool
        label={t('text')}
        isPressed={isTextShown}
        testId="universe-text"
        onClick={() => setState({ isTextShown: !isTextShown })}
      >
        <IconCode size={18} />
      </Tool>
      <Button
        size="xs"
        leftSection={<IconPlayerPlayFilled size={14} />}
        disabled={!canRun}
        data-testid="run-here"
        onClick={runHere}
      >
        {t('runHere')}
      </Button>
    </div>
  );
}

interface ToolProps {
  readonly label: string;
  readonly isPressed?: boolean;
  readonly isDisabled?: boolean;
  readonly testId?: string;
  readonly onClick: () => void;
  readonly children: ReactNode;
}

function Tool({ label, isPressed, isDisabled = false, testId, onClick, children }: ToolProps) {
  return (
    <Tooltip label={label}>
      <ActionIcon
        size="md"
        variant={isPressed ? 'light' : 'subtle'}
        color={isPressed ? 'indigo' : 'gray'}
        aria-label={label}
        disabled={isDisabled}
        {...(isPressed === undefined ? {} : { 'aria-pressed': isPressed })}
        {...(testId ? { 'data-testid': testId } : {})}
        onClick={onClick}
      >
        {children}
      </ActionIcon>
    </Tooltip>
  );
}

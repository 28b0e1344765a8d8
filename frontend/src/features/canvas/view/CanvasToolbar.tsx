import { ActionIcon, Tooltip } from '@mantine/core';
import {
  IconAdjustmentsHorizontal,
  IconArrowsVertical,
  IconArrowsHorizontal,
  IconFocusCentered,
  IconLayoutDistributeHorizontal,
  IconLayoutList,
  IconMap2,
  IconMaximize,
  IconMinus,
  IconPlus,
  IconSearch,
  IconX,
  type Icon,
} from '@tabler/icons-react';
import { useReactFlow, useStore } from '@xyflow/react';
import { memo, useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { shortcutLabel } from '@/commands/shortcuts';
import { CommandButton } from '@/ui/CommandButton';
import { setLayout, tidy } from '@/model/edits';
import { change } from '@/store/project/edits/blocks';
import { useIsBasic } from '@/store/viewMode';
import { isMinimapShown, setEditor, useEditorStore } from '@/store/project/editor';
import { useProjectStore } from '@/store/project';
import { FIT_KEYS } from '../commands/canvasCommands';
import type { BlockNode, TreeEdge } from '../flow';
import { toggleCompact, useCompact } from './compact';
import { FIT } from './useViewport';
import { fit, fitSelection, showsTree, zoomIn, zoomReset } from './views';
import classes from '../Canvas.module.css';

/** The canvas size below which the tools are combined into one button, since they would cover the tree. */
const ROOM = { width: 560, height: 320 } as const;

interface ToolProps {
  readonly label: string;
  readonly icon: Icon;
  readonly onClick: () => void;
  readonly testId?: string;
  readonly isOn?: boolean;
  readonly isExpanded?: boolean;
}

function Tool({ label, icon: Symbol, onClick, testId, isOn, isExpanded }: ToolProps) {
  return (
    <Tooltip label={label} position="top">
      <ActionIcon
        aria-label={label}
        onClick={onClick}
        size={30}
        {...(testId === undefined ? {} : { 'data-testid': testId })}
        {...(isOn === undefined ? {} : { 'aria-pressed': isOn })}
        {...(isExpanded === undefined ? {} : { 'aria-expanded': isExpanded })}
      >
        <Symbol size={17} stroke={1.8} aria-hidden="true" />
      </ActionIcon>
    </Tooltip>
  );
}

/** The toolbar below the tree: zoom, layout and search. */
export const CanvasToolbar = memo(function CanvasToolbar({ treeId }: { readonly treeId: string }) {
  const { t } = useTranslation('canvas');
  const flow = useReactFlow<BlockNode, TreeEdge>();
  const zoom = useStore((state) => Math.round(state.transform[2] * 100));
  const isHorizontal = useProjectStore((state) => state.diagrams[treeId]?.layout === 'horizontal');
  const hasSelection = useProjectStore((state) => state.activeTree === treeId && state.selection.length > 0);
  const wish = useEditorStore((state) => state.minimap);
  const minimap = useProjectStore((state) =>
    isMinimapShown(wish, Object.keys(state.diagrams[treeId]?.nodes ?? {}).length),
  );

  useEffect(() => showsTree(treeId, flow), [treeId, flow]);

  const isSmall = useStore(({ width, height }) => width > 0 && (width < ROOM.width || height < ROOM.height));
  const isCompact = useCompact((state) => state.isCompact);
  const isBasic = useIsBasic();
  const [isOpen, setOpen] = useState(false);
  const toggle = (
    <Tool
      label={t(isOpen ? 'toolbar.close' : 'toolbar.open')}
      icon={isOpen ? IconX : IconAdjustmentsHorizontal}
      testId="toolbar-toggle"
      isExpanded={isOpen}
      onClick={() => setOpen(!isOpen)}
    />
  );
  if (isSmall && !isOpen) {
    return (
      <div className={classes['toolbar']} role="toolbar" aria-label={t('toolbar.label')}>
        {toggle}
      </div>
    );
  }

  return (
    <div className={classes['toolbar']} role="toolbar" aria-label={t('toolbar.label')}>
      {isSmall && toggle}
      <Tool
        label={t('toolbar.zoomOut')}
        icon={IconMinus}
        onClick={() => void flow.zoomOut({ duration: 120 })}
      />
      {isBasic ? null : (
        <Tooltip label={t('toolbar.zoomReset')}>
          <button
            type="button"
            className={classes['zoom']}
            onClick={zoomReset}
            aria-label={`${zoom}% · ${t('toolbar.zoomReset')}`}
          >
            {zoom}%
          </button>
        </Tooltip>
      )}
      <Tool label={t('toolbar.zoomIn')} icon={IconPlus} onClick={zoomIn} />
      <Tool
        label={`${t('toolbar.fit')} (${shortcutLabel(FIT_KEYS.all)})`}
        icon={IconMaximize}
        onClick={fit}
      />
      {hasSelection && (
        <Tool
          label={`${t('toolbar.fitSelection')} (${shortcutLabel(FIT_KEYS.selection)})`}
          icon={IconFocusCentered}
          onClick={fitSelection}
        />
      )}
      <span className={classes['divider']} />
      <Tool
        label={t('toolbar.tidy')}
        icon={IconLayoutDistributeHorizontal}
        testId="tidy"
        onClick={() => {
          change('tidy', [tidy()]);
          // The view is fitted after React has drawn the new layout.
          requestAnimationFrame(() => void flow.fitView({ ...FIT, duration: 200 }));
        }}
      />
      {isBasic ? null : (
        <>
          <Tool
            label={t(isHorizontal ? 'toolbar.vertical' : 'toolbar.horizontal')}
            icon={isHorizontal ? IconArrowsVertical : IconArrowsHorizontal}
            testId="orientation"
            onClick={() => {
              change('orientation', [setLayout(isHorizontal ? 'vertical' : 'horizontal')]);
            }}
          />
          <Tool
            label={t('toolbar.compact')}
            icon={IconLayoutList}
            testId="compact"
            isOn={isCompact}
            onClick={toggleCompact}
          />
          <span className={classes['divider']} />
          <Tool
            label={t('toolbar.find')}
            icon={IconSearch}
            onClick={() => {
              setEditor({ find: true });
            }}
          />
          <Tool
            label={t('toolbar.minimap')}
            icon={IconMap2}
            isOn={minimap}
            onClick={() => {
              setEditor({ minimap: !minimap });
            }}
          />
          <CommandButton command="tests.coverage" size={30} testId="toggle-coverage" />
          <CommandButton command="view.xml" size={30} testId="toggle-xml" />
        </>
      )}
    </div>
  );
});

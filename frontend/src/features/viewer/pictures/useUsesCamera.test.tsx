import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { openProject, show } from '../../../../harness/testing';
import { useUsesCamera } from './useUsesCamera';

const Probe = () => <p>{useUsesCamera() ? 'pictures' : 'none'}</p>;

describe('useUsesCamera', () => {
  it.each([
    ['actions/See.py', 'from sensor_msgs.msg import Image', 'pictures'],
    ['actions/See.py', 'import sensor_msgs.msg as s\n\nx = s.CompressedImage', 'pictures'],
    ['actions/See.py', 'from sensor_msgs.msg import LaserScan', 'none'],
    ['actions/See.py', 'from sensor_msgs.msg import Images', 'none'],
    ['actions/See.py', 'from PIL import Image', 'none'],
    ['notes.md', 'from sensor_msgs.msg import Image', 'none'],
  ])('of %s that says "%s": %s', (path, text, found) => {
    openProject({ texts: { [path]: text } });
    show(<Probe />);
    expect(screen.getByText(found)).toBeInTheDocument();
  });

  it('follows edits', () => {
    openProject({ texts: { 'actions/See.py': '' } });
    show(<Probe />);
    act(() => useProjectStore.getState().setFileText('actions/See.py', 'import sensor_msgs.msg.Image'));
    expect(useProjectStore.getState().currentText('actions/See.py')).toContain('sensor_msgs');
    expect(screen.getByText('pictures')).toBeInTheDocument();
  });
});
